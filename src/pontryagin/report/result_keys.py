"""The keys of kept results: what the modules that keep results are made of, handed to what the build runs."""

import json
import sys

from pontryagin.io import files, kept_results
from pontryagin.report import dependencies
from pontryagin.report.environment import FIXED_KEY
from pontryagin.report.workspace import Workspace

_KEEPER = kept_results.__name__
"""The module that keeps results."""


def hand_down(workspace: Workspace) -> dict[str, str]:
    """Write the key of each module whose results are kept, where the processes of this build look for it.

    Returns
    -------
    dict
        Dotted name of the module -> key.
    """
    source = dependencies.Source(workspace.source)
    keys = {module: _key(workspace, source, module) for module in sorted(_keeping(source))}
    files.write(workspace.results / kept_results.KEYS, json.dumps(keys, indent=1))
    return keys


def _keeping(source: dependencies.Source) -> set[str]:
    """Modules that keep results themselves, and the claims, whose checks the ledger keeps."""
    using = {module for module in source.modules if _KEEPER in source.needs(module)}
    claims = set().union(*map(source.below, source.rooms({dependencies.CLAIMS})))
    return using | claims


def _key(workspace: Workspace, source: dependencies.Source, module: str) -> str:
    parts = sorted(dependencies.reached(source, [module]))
    return dependencies.digest(*parts, workspace.lock_text, sys.version, FIXED_KEY, root=workspace.root)
