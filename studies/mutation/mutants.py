"""Mutants of a module: each is its source with one small change that should make a test fail."""

import ast
import hashlib
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass

NEGATED: dict[type[ast.cmpop], type[ast.cmpop]] = {
    ast.Lt: ast.GtE,
    ast.GtE: ast.Lt,
    ast.Gt: ast.LtE,
    ast.LtE: ast.Gt,
    ast.Eq: ast.NotEq,
    ast.NotEq: ast.Eq,
    ast.Is: ast.IsNot,
    ast.IsNot: ast.Is,
    ast.In: ast.NotIn,
    ast.NotIn: ast.In,
}
BOUNDARY: dict[type[ast.cmpop], type[ast.cmpop]] = {
    ast.Lt: ast.LtE,
    ast.LtE: ast.Lt,
    ast.Gt: ast.GtE,
    ast.GtE: ast.Gt,
}
ARITHMETIC: dict[type[ast.operator], type[ast.operator]] = {
    ast.Add: ast.Sub,
    ast.Sub: ast.Add,
    ast.Mult: ast.Div,
    ast.Div: ast.Mult,
    ast.FloorDiv: ast.Div,
    ast.Mod: ast.Mult,
    ast.Pow: ast.Mult,
    ast.BitAnd: ast.BitOr,
    ast.BitOr: ast.BitAnd,
}
NAMES = {
    "min": "max",
    "max": "min",
    "minimum": "maximum",
    "maximum": "minimum",
    "all": "any",
    "any": "all",
    "argmin": "argmax",
    "argmax": "argmin",
    "floor": "ceil",
    "ceil": "floor",
    "sin": "cos",
    "cos": "sin",
    "logical_and": "logical_or",
    "logical_or": "logical_and",
}
"""Functions and methods, each with one that is easily written in its place."""


@dataclass(frozen=True)
class Mutant:
    """A change of one expression or statement of a module.

    Attributes
    ----------
    kind : str
        What was changed: "boundary", "comparison", "arithmetic", "constant", "sign", "not", "and or",
        "function", "statement" or "loop".
    function : str
        The function that holds it, with its class; empty at the level of the module.
    line, last : int
        Its first and its last line.
    before, after : str
        The text that is replaced, and the text in its place.
    start, end : int
        Where the text that is replaced begins and ends in the source's bytes.
    key : str
        A hash of the module's name, the function, the line, and the change. A change elsewhere in the module
        does not alter it.
    """

    kind: str
    function: str
    line: int
    last: int
    before: str
    after: str
    start: int
    end: int
    key: str

    def source(self, original: str) -> str:
        """The source of the module with the change."""
        text = original.encode()
        return (text[: self.start] + self.after.encode() + text[self.end :]).decode()


def mutants(source: str, module: str) -> list[Mutant]:
    """All mutants of a module, in the order of its text.

    Parameters
    ----------
    source : str
        The module's text.
    module : str
        Its dotted name, which enters the keys.
    """
    lines = source.encode().splitlines(keepends=True)
    starts = [0]
    for line in lines:
        starts.append(starts[-1] + len(line))
    found, seen = [], Counter[str]()
    for node, function in _within(ast.parse(source)):
        for kind, other in _changes(node):
            start, end = _place(starts, node)
            before, after = source.encode()[start:end].decode(), _text(other)
            whole = lines[node.lineno - 1].decode().strip()  # type: ignore[attr-defined]
            text = "\n".join([module, function, whole, before, after])
            seen[text] += 1
            key = hashlib.sha256(f"{text}\n{seen[text]}".encode()).hexdigest()[:12]
            first, last = node.lineno, node.end_lineno  # type: ignore[attr-defined]
            found.append(Mutant(kind, function, first, last, before, after, start, end, key))
    return sorted(found, key=lambda mutant: (mutant.start, mutant.end, mutant.after))


def _within(node: ast.AST, function: str = "") -> Iterator[tuple[ast.AST, str]]:
    """The nodes that are computed when the module runs, each with the function that holds it.

    Types, texts and decorators are left out: a test of mathematics cannot see them.
    """
    if isinstance(node, ast.FunctionDef | ast.ClassDef):
        function = f"{function}.{node.name}".lstrip(".")
    for name, value in ast.iter_fields(node):
        if name in {"annotation", "returns", "decorator_list", "type_params", "bases"}:
            continue
        for child in value if isinstance(value, list) else [value]:
            if isinstance(child, ast.AST) and not isinstance(child, ast.JoinedStr):
                if isinstance(child, ast.If) and ast.unparse(child.test) == "TYPE_CHECKING":
                    continue
                if hasattr(child, "lineno"):
                    yield child, function
                yield from _within(child, function)


def _changes(node: ast.AST) -> Iterator[tuple[str, ast.AST]]:
    match node:
        case ast.Compare(left, operators, sides):
            for i, operator in enumerate(operators):
                for kind, table in (("boundary", BOUNDARY), ("comparison", NEGATED)):
                    if type(operator) in table:
                        changed = [*operators[:i], table[type(operator)](), *operators[i + 1 :]]
                        yield kind, ast.Compare(left, changed, sides)
        case ast.BinOp(left, operator, right) if type(operator) in ARITHMETIC and not _is_text(left):
            yield "arithmetic", ast.BinOp(left, ARITHMETIC[type(operator)](), right)
        case ast.AugAssign(target, operator, value) if type(operator) in ARITHMETIC:
            yield "arithmetic", ast.AugAssign(target, ARITHMETIC[type(operator)](), value)
        case ast.BoolOp(operator, values):
            yield "and or", ast.BoolOp(ast.Or() if isinstance(operator, ast.And) else ast.And(), values)
        case ast.UnaryOp(ast.USub(), operand):
            yield "sign", operand
        case ast.UnaryOp(ast.Not(), operand):
            yield "not", operand
        case ast.Constant(value):
            yield from (("constant", ast.Constant(other)) for other in _other_constants(value))
        case ast.Call(ast.Name(name), given, named) if name in NAMES and given:
            yield "function", ast.Call(ast.Name(NAMES[name]), given, named)
        case ast.Call(ast.Attribute(holder, name), given, named) if name in NAMES:
            yield "function", ast.Call(ast.Attribute(holder, NAMES[name]), given, named)
        case ast.Expr(ast.Call()) | ast.Raise() | ast.Assign([ast.Subscript() | ast.Attribute()]):
            yield "statement", ast.Pass()
        case ast.Break():
            yield "loop", ast.Continue()
        case ast.Continue():
            yield "loop", ast.Break()


def _is_text(node: ast.AST) -> bool:
    return isinstance(node, ast.JoinedStr) or (isinstance(node, ast.Constant) and isinstance(node.value, str))


def _other_constants(value: object) -> list[bool | int | float]:
    """A flag the other way; a whole number one larger; a number by a factor of two, zero one off."""
    if isinstance(value, bool):
        return [not value]
    if isinstance(value, int):
        return [value + 1]
    if isinstance(value, float):
        return [2 * value if value else 1.0]
    return []


def _text(node: ast.AST) -> str:
    text = ast.unparse(ast.fix_missing_locations(node))
    return f"({text})" if isinstance(node, ast.BinOp | ast.BoolOp | ast.Compare | ast.UnaryOp) else text


def _place(starts: list[int], node: ast.AST) -> tuple[int, int]:
    begins = starts[node.lineno - 1] + node.col_offset  # type: ignore[attr-defined]
    ends = starts[node.end_lineno - 1] + node.end_col_offset  # type: ignore[attr-defined]
    return begins, ends
