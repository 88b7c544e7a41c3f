"""What a notebook or a module is made of: every file of the package that running it can read.

Imports are followed without running anything. What cannot be decided is counted in: a module that imports
by a computed name depends on its whole package, one that looks for files depends on those beside it. What is
imported late is counted where it is asked for: a module of a lazy package where its name is taken from the
package, or where the package itself is at hand; the claims of all papers where the ledger's entries are.
"""

import ast
import hashlib
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from pontryagin.report.syntax import LEDGER, asks_the_ledger, looks_for_files, parsed, telling

_COMPUTED = {"import_module", "__import__", "walk_packages", "iter_modules", "find_spec"}
_LAZY = {"attach", "attach_stub"}
"""Functions of `lazy_loader` that import modules below the package that calls them."""
_PAPERS = "papers"
"""The module whose `room` imports a module of each paper by its name."""
CLAIMS = "claims"
"""The module of a paper that it loads."""
_WHOLE = "*"
"""Stands for the package as an object, from which whatever is loaded can be taken."""
_COMMANDS = {"system", "getoutput", "run_cell_magic", "run_line_magic", "Popen", "check_output", "check_call"}
_ABOVE_THE_PAPERS = ("report", "cli", "__main__")


@dataclass(frozen=True)
class Source:
    """The modules of a package in the folder `folder`, by dotted name."""

    folder: Path

    @cached_property
    def modules(self) -> dict[str, Path]:
        """Dotted name -> file, for every module and package."""
        found = {}
        for path in sorted(self.folder.rglob("*.py")):
            parts = [self.folder.name, *path.relative_to(self.folder).with_suffix("").parts]
            found[".".join(parts[:-1] if parts[-1] == "__init__" else parts)] = path
        return found

    def below(self, package: str) -> set[str]:
        """All modules of a package; those above the papers are no paper's business."""
        above = tuple(f"{self.folder.name}.{name}" for name in _ABOVE_THE_PAPERS)
        inside = {name for name in self.modules if name == package or name.startswith(package + ".")}
        return inside if package.startswith(above) else {m for m in inside if not m.startswith(above)}

    def attached(self, package: str) -> dict[str, str]:
        """What a lazy package imports when it is taken from it: name -> module, as its stub says."""
        stub = self.modules[package].with_suffix(".pyi")
        tree = parsed(stub.read_text(encoding="utf-8")) if stub.is_file() else ast.Module([], [])
        lines = [node for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)]
        found = {}
        for line in lines:
            base = _absolute(line, package)
            for alias in line.names:
                inner = f"{base}.{alias.name}"
                found[alias.asname or alias.name] = inner if inner in self.modules else base
        return found

    def is_lazy(self, package: str) -> bool:
        """Whether a package imports what is taken from it only then."""
        if package not in self.modules or self.modules[package].name != "__init__.py":
            return False
        calls = (
            n for n in telling(self.modules[package].read_text(encoding="utf-8")) if isinstance(n, ast.Call)
        )
        return any(_name_of(call) in _LAZY for call in calls)

    def taken(self, package: str, name: str | None = None) -> set[str]:
        """The modules that a lazy package imports for a name that is taken from it, or for all names."""
        if not self.is_lazy(package):
            return set()
        offered = self.attached(package)
        if name in offered:
            return {offered[name]}
        if name and f"{package}.{name}" in self.modules:
            return set()
        return set(offered.values()) or self.below(package)

    def needs(self, module: str) -> set[str]:
        """The modules that a module may import by itself; its text is read once."""
        if module not in self._needs:
            self._needs[module] = self._needed_by(module)
        return self._needs[module]

    @cached_property
    def _needs(self) -> dict[str, set[str]]:
        return {}

    def _needed_by(self, module: str) -> set[str]:
        if module == f"{self.folder.name}.{_PAPERS}":
            return set()  # what its computed imports reach is counted where its function is called
        text = self.modules[module].read_text(encoding="utf-8")
        found = needed(self, text, self.package_of(module)) | _parents(self, module)
        offers = module in {f"{self.folder.name}.{name}" for name in LEDGER}
        return found - self.rooms({CLAIMS}) if offers else found

    def rooms(self, names: set[str]) -> set[str]:
        """The modules of these names in the papers' folders."""
        return {m for m in self.modules if m.count(".") == 2 and m.rpartition(".")[2] in names}

    def package_of(self, module: str) -> str:
        """The package that a relative import in `module` starts from."""
        is_package = self.modules[module].name == "__init__.py"
        return module if is_package else module.rpartition(".")[0]


def closure(source: Source, code: Iterable[str]) -> set[Path]:
    """Files of the package that pieces of code depend on, directly or through other modules.

    Parameters
    ----------
    source : Source
        The package.
    code : iterable of str
        Python text: a notebook's cells, or ``import package.module`` for a module.

    Returns
    -------
    set of Path
        Modules and, for those that look for files, what lies beside them.
    """
    return reached(source, set().union(*(needed(source, text, source.folder.name) for text in code), set()))


def reached(source: Source, modules: Iterable[str]) -> set[Path]:
    """Files of the package that modules depend on when they are imported by name, and these themselves."""
    open_names, known = set(modules), set[str]()
    while open_names:
        module = open_names.pop()
        if module in known:
            continue
        known.add(module)
        open_names |= set() if module == _WHOLE else source.needs(module)
        if _WHOLE in known:
            open_names |= set().union(*map(source.taken, known))
    files = {source.modules[module] for module in known - {_WHOLE}}
    return files | {data for path in files for data in _data_beside(source, path)}


def uncounted(source: Source, loaded: Iterable[str], counted: set[Path]) -> list[str]:
    """Which of the modules that a process has loaded, by name, are not among the files that were counted."""
    return [name for name in loaded if name in source.modules and source.modules[name] not in counted]


def digest(*parts: bytes | str | Path, root: Path | None = None) -> str:
    """A key that changes when any part does; a path counts with its place below `root` and its content."""
    state = hashlib.sha256()
    for part in parts:
        if isinstance(part, Path):
            content = str(part.relative_to(root) if root else part.name).encode() + b"\0" + part.read_bytes()
        else:
            content = part.encode() if isinstance(part, str) else part
        state.update(len(content).to_bytes(8, "big") + content)
    return state.hexdigest()[:24]


def needed(source: Source, text: str, package: str) -> set[str]:
    """The modules that a piece of code in `package` may import by itself."""
    try:
        nodes = telling(text)
    except SyntaxError:
        return source.below(source.folder.name)
    found = source.rooms({CLAIMS}) if asks_the_ledger(text) else set()
    for node in nodes:
        if isinstance(node, ast.Import):
            found |= set().union(*(_imported(source, alias) for alias in node.names))
        elif isinstance(node, ast.ImportFrom):
            base = _absolute(node, package)
            found |= set().union(*(_taken_from(source, base, alias.name) for alias in node.names))
        elif isinstance(node, ast.Constant) and isinstance(node.value, str):
            if node.value in source.modules:
                found |= _named(source, node.value) | source.taken(node.value)
        elif isinstance(node, ast.Call):
            found |= _called(source, node, package)
    return found


def _imported(source: Source, alias: ast.alias) -> set[str]:
    """What ``import name`` loads; without ``as`` it puts the outermost package at hand."""
    outermost = alias.name.split(".")[0] == source.folder.name and not alias.asname
    bound = {_WHOLE} if outermost else source.taken(alias.name)
    return _named(source, alias.name) | bound


def _taken_from(source: Source, base: str, name: str) -> set[str]:
    """What ``from base import name`` loads."""
    if name == "*":
        return _named(source, base) | source.below(base)
    whole = f"{base}.{name}"
    lazily = source.taken(base, name)
    deeper = set().union(*(_named(source, module) | source.taken(module) for module in lazily), set())
    return _named(source, whole) | source.taken(whole) | deeper


def _called(source: Source, call: ast.Call, package: str) -> set[str]:
    name = _name_of(call)
    if name == "room" and (call.args or call.keywords):
        names = {str(node.value) for node in ast.walk(call) if isinstance(node, ast.Constant)}
        return source.rooms(names) if names else source.below(source.folder.name)
    if name not in _COMPUTED | _COMMANDS:
        return set()
    written = [node.value for node in ast.walk(call) if isinstance(node, ast.Constant)]
    if name in _COMPUTED:
        constant = bool(call.args) and isinstance(call.args[0], ast.Constant)
        exact = constant and str(written[0]) in source.modules
        return set() if exact else source.below(package)
    named = any(source.folder.name in str(value) for value in written)
    return source.below(source.folder.name) if named else set()


def _name_of(call: ast.Call) -> str:
    return call.func.attr if isinstance(call.func, ast.Attribute) else getattr(call.func, "id", "")


def _absolute(node: ast.ImportFrom, package: str) -> str:
    if node.level == 0:
        return node.module or ""
    start = package.split(".")[: len(package.split(".")) - node.level + 1]
    return ".".join([*start, *([node.module] if node.module else [])])


def _named(source: Source, name: str) -> set[str]:
    parts = name.split(".")
    prefixes = (".".join(parts[: i + 1]) for i in range(len(parts)))
    return {prefix for prefix in prefixes if prefix in source.modules}


def _parents(source: Source, module: str) -> set[str]:
    return _named(source, module) - {module}


def _data_beside(source: Source, path: Path) -> set[Path]:
    """What a module that looks for files may find; what lies above the papers is found from there alone."""
    if not looks_for_files(path.read_text(encoding="utf-8")):
        return set()
    above = [source.folder / name for name in _ABOVE_THE_PAPERS]
    hidden = [folder for folder in above if not path.is_relative_to(folder)]
    beside = (found for found in path.parent.rglob("*") if found.is_file())
    return {
        found
        for found in beside
        if found.suffix not in {".py", ".pyc"} and not any(map(found.is_relative_to, hidden))
    }
