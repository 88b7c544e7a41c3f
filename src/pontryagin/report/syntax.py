"""What a text of Python names: modules, files, the ledger; read from its syntax tree, never run."""

import ast
import threading
from functools import cache

LEDGER = ("ledger", "ledger.collection")
"""The modules that offer the function by which the claims of all papers are loaded."""
COLLECTED = "entries"
"""The name of that function."""
_FILE_READERS = {"__file__", "resources", "pkgutil", "__path__"}
_ONE_AT_A_TIME = threading.Lock()


def parsed(text: str) -> ast.Module:
    """Its syntax tree; CPython 3.11 counts the depth of all threads' trees together, and may trip over it."""
    with _ONE_AT_A_TIME:
        return ast.parse(text)


@cache
def telling(text: str) -> tuple[ast.AST, ...]:
    """The nodes of its syntax tree that can name a module."""
    kinds = (ast.Import, ast.ImportFrom, ast.Constant, ast.Call)
    return tuple(node for node in ast.walk(parsed(text)) if isinstance(node, kinds))


@cache
def asks_the_ledger(text: str) -> bool:
    """Whether it takes the function that loads all claims from the ledger, or passes the ledger on."""
    if LEDGER[0] not in text:
        return False
    nodes = list(ast.walk(parsed(text)))
    of_attribute = {id(node.value) for node in nodes if isinstance(node, ast.Attribute)}
    places = {name.rpartition(".")[2] for name in LEDGER}
    for node in nodes:
        if isinstance(node, ast.ImportFrom) and (node.module or "").rpartition(".")[2] in places:
            asks = bool({alias.name for alias in node.names} & {COLLECTED, "*"})
        elif isinstance(node, ast.alias):
            asks = node.asname not in {None, node.name} and node.name.rpartition(".")[2] in places
        elif isinstance(node, ast.Attribute) and node.attr == COLLECTED:
            asks = True
        else:
            named = getattr(node, "attr", getattr(node, "id", "")) in places
            asks = named and isinstance(node, ast.Attribute | ast.Name) and id(node) not in of_attribute
        if asks:
            return True
    return False


@cache
def looks_for_files(text: str) -> bool:
    """Whether it may find files beside it, by its own place or by that of its package."""
    if not any(name in text for name in _FILE_READERS):
        return False
    tree = parsed(text)
    names = {getattr(node, "id", None) or getattr(node, "attr", None) for node in ast.walk(tree)}
    imported = {
        alias.name for node in ast.walk(tree) if isinstance(node, ast.ImportFrom) for alias in node.names
    }
    return bool(_FILE_READERS & (names | imported))


def literals(text: str) -> set[str]:
    """The short strings written in a piece of code; those that name a file are read by it, perhaps."""
    try:
        tree = parsed(text)
    except SyntaxError:
        return set()
    strings = (node.value for node in ast.walk(tree) if isinstance(node, ast.Constant))
    return {s for s in strings if isinstance(s, str) and 0 < len(s) < 200 and "\n" not in s and "\0" not in s}
