"""Mutants of the modules that decide; see `studies.mutation.study`."""
