"""Files and texts: formulas, rows of a table, paths."""
