"""The public classes of the papers, read off their packages: named in `__all__`, or returned from there."""

import importlib
import inspect
import pkgutil
import sys
from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from types import ModuleType
from typing import Any, get_args, get_origin, get_type_hints

from pontryagin.averaging.system.model import Model
from pontryagin.papers import packages

MACHINERY = {Model}
"""Classes that are neither problem, solution nor certificate."""


def public_classes() -> set[type]:
    """The dataclasses that are public names of a paper, or that its public functions return.

    To these come the dataclasses in their public fields, and those that their methods return.
    """
    named = {cls for package in packages() for cls in _classes_of_a_paper(package)}
    reached = {found for cls in named for found in _reached(cls)}
    return {cls for cls in named | reached if is_dataclass(cls)} - MACHINERY


def _classes_of_a_paper(package: str) -> Iterator[type]:
    for module in _public_modules(f"pontryagin.{package}"):
        for name in getattr(module, "__all__", dir(module)):
            value = inspect.unwrap(getattr(module, name))
            if not hasattr(module, "__all__") and getattr(value, "__module__", "") != module.__name__:
                continue
            if isinstance(value, type):
                yield value
            elif inspect.isfunction(value):
                yield from _within(_hints(value).get("return"))


def _public_modules(package: str) -> Iterator[ModuleType]:
    """The package, its packages that list their names, and the modules that are public names of it."""
    paper = importlib.import_module(package)
    yield paper
    rooms = [room.name for room in pkgutil.iter_modules(paper.__path__, f"{package}.") if room.ispkg]
    yield from (room for room in map(importlib.import_module, rooms) if hasattr(room, "__all__"))
    named = (getattr(paper, name) for name in paper.__all__)
    yield from (one for one in named if isinstance(one, ModuleType) and not hasattr(one, "__path__"))


def _reached(cls: type) -> Iterator[type]:
    """The project's classes in the public fields of a class, and in what its public methods return."""
    if is_dataclass(cls):
        hints = _hints(cls)
        yield from (part for entry in fields(cls) for part in _within(hints[entry.name]))
    for name, member in inspect.getmembers_static(cls):
        function = getattr(member, "fget", None) or getattr(member, "func", None) or member
        if inspect.isfunction(function) and not name.startswith("_"):
            yield from _within(_hints(function).get("return"))


def _hints(thing: Any) -> dict[str, Any]:
    """The annotations of a function or a class; names that only a type checker imports are looked up."""
    paper = ".".join(thing.__module__.split(".")[:2])
    known = {name: value for module in _loaded(paper) for name, value in vars(module).items()}
    if isinstance(thing, type):
        return get_type_hints(thing, localns=known | vars(sys.modules[thing.__module__]))
    return get_type_hints(thing, known | inspect.unwrap(thing).__globals__)


def _loaded(package: str) -> list[ModuleType]:
    return [module for name, module in sorted(sys.modules.items()) if name.startswith(package)]


def _within(annotation: Any) -> Iterator[type]:
    parts = [get_origin(annotation), *get_args(annotation)]
    for part in parts if get_origin(annotation) else [annotation]:
        if isinstance(part, type) and part.__module__.startswith("pontryagin."):
            yield part
        elif get_origin(part):
            yield from _within(part)
