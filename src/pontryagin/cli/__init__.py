"""The command line: ``pontryagin solve PROBLEM``, ``pontryagin ledger``, ``pontryagin report``.

A paper's problem is the module ``command`` in its folder. The module holds one function ``solve`` whose
annotations are its options (typer) and whose docstring is its help, with examples at the end after a line of
``\\b``. The folder's name is the command's: ``triple_integrator`` is ``pontryagin solve triple-integrator``.
`pontryagin.terminal.console` has what such functions share.

problems   the papers' commands, imported when they are called
ledger     the ledger as a table, CSV or JSON
report     building the report
failures   errors and warnings in one line, exit codes
app        all of it together
"""

from pontryagin.cli.app import app, main

__all__ = ["app", "main"]
