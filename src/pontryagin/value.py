"""Value classes: frozen dataclasses of arrays that compare, hash, pickle and copy by value."""

import sys
from abc import abstractmethod
from collections.abc import Mapping
from dataclasses import MISSING, Field, fields, is_dataclass
from functools import cached_property, partial, wraps
from types import FunctionType
from typing import TYPE_CHECKING, Any, Self, TypeVar

import numpy as np
from numpy.typing import NDArray

Class = TypeVar("Class")

NAN = object()
"""Takes the place of nan in comparisons, since nan does not equal itself."""


def value_class(cls: type[Class]) -> type[Class]:
    """Make a dataclass compare, hash and pickle by value; used above ``@dataclass(frozen=True, eq=False)``.

    Two instances are equal if they are of one class and all their fields are equal: arrays entry by entry
    with nan equal to nan; nested dataclasses, tuples and mappings by what they hold; functions by identity.
    A field made with ``field(compare=False)`` is left out. Equal instances have equal hashes.

    Arrays in fields, in tuples and mappings in fields, and in cached properties become read-only, without a
    copy: a class that takes arrays from a user copies them in ``__post_init__``. Pickles and copies hold the
    fields alone; cached properties are then computed again, and are read-only again. A deep copy shares what
    the fields hold. Plain pickle refuses a lambda or an inner function in a field with a message that names
    the field; cloudpickle takes it. Methods ``__eq__``, ``__hash__``, ``__getstate__`` and ``__setstate__``
    that a class defines itself are kept. So is the ``__init__`` of a dataclass with ``init=False``, which
    must make its arrays read-only by `freeze`.

    Examples
    --------
    >>> from dataclasses import dataclass
    >>> @value_class
    ... @dataclass(frozen=True, eq=False)
    ... class Reading:
    ...     time: float
    ...     levels: NDArray[np.float64]
    >>> one, two = (Reading(0.5, np.array([1.0, np.nan])) for _ in range(2))
    >>> one == two, hash(one) == hash(two), one == 0.5, one.levels.flags.writeable
    (True, True, False, False)
    """
    for attribute in (attribute for base in cls.__mro__ for attribute in vars(base).values()):
        if isinstance(attribute, cached_property) and not hasattr(attribute.func, "freezes"):
            attribute.func = _read_only(attribute.func)
    methods = {
        "__eq__": _equal,
        "__hash__": _hash,
        "__getstate__": _state,
        "__setstate__": _restore,
        "__copy__": _copy,
        "__deepcopy__": _copy,
    }
    for name in methods.keys() - vars(cls).keys():
        setattr(cls, name, methods[name])
    if cls.__dataclass_params__.init:  # type: ignore[attr-defined]
        setattr(cls, "__init__", _initialiser(cls))  # noqa: B010
    return cls


class Packed:
    """Base of value classes whose fields can be made later, from numbers packed in `bytes`.

    A subclass defines `_unpacked`, which makes all fields that its instances do not hold yet.
    """

    @classmethod
    def from_numbers(cls, numbers: bytes) -> Self:
        """An instance whose fields are made when the first of them is read."""
        made = object.__new__(cls)
        made.__dict__["_numbers"] = numbers
        return made

    @abstractmethod
    def _unpacked(self, numbers: NDArray[np.float64]) -> dict[str, Any]:
        """The fields from the numbers, which are read-only."""

    if not TYPE_CHECKING:  # Type checkers would take any name for an attribute.

        def __getattr__(self, name: str) -> Any:
            """A field that is not made yet."""
            numbers = self.__dict__.get("_numbers")
            if numbers is None or name not in type(self).__dataclass_fields__:
                raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}")
            held = self.__dict__
            for field, value in self._unpacked(np.frombuffer(numbers)).items():
                if type(value) is np.ndarray:
                    value.setflags(write=False)
                held.setdefault(field, value)
            return held[name]


def freeze(value: object) -> None:
    """Make an array read-only, or the arrays in a tuple or a mapping."""
    if isinstance(value, np.ndarray):
        value.setflags(write=False)
    elif isinstance(value, tuple):
        for entry in value:
            freeze(entry)
    elif isinstance(value, Mapping):
        for entry in value.values():
            freeze(entry)


def _initialiser(cls: Any) -> Any:
    """An ``__init__`` with the signature that `dataclass` gives it, which fills ``__dict__`` directly.

    It takes half the time of a frozen dataclass's own, which makes up for the time to freeze the arrays.
    """
    given = {entry.name: entry for entry in fields(cls)}
    parameters = [entry for entry in given.values() if entry.init]
    plain = [_parameter(entry) for entry in parameters if not entry.kw_only]
    named = [_parameter(entry) for entry in parameters if entry.kw_only]
    lines = [
        f"def __init__({', '.join(['self', *plain, *(['*', *named] if named else [])])}):",
        "    values = self.__dict__",
        *(f"    values[{name!r}] = {_initial(entry)}" for name, entry in given.items()),
        *(["    self.__post_init__()"] if hasattr(cls, "__post_init__") else []),
        "    for value in values.values():",
        "        kind = type(value)",
        "        if kind is ndarray:",
        "            value.setflags(False)",
        "        elif kind is tuple or kind is dict:",
        "            freeze(value)",
    ]
    names: dict[str, Any] = {"given": given, "MISSING": MISSING, "ndarray": np.ndarray, "freeze": freeze}
    exec("\n".join(lines), names)
    return wraps(cls.__init__)(names["__init__"])


def _parameter(entry: Field[Any]) -> str:
    """A field as a parameter of ``__init__``; the default is MISSING where a factory makes the value."""
    required = entry.default is MISSING and entry.default_factory is MISSING
    return entry.name if required else f"{entry.name}=given[{entry.name!r}].default"


def _initial(entry: Field[Any]) -> str:
    """The expression for the value that ``__init__`` stores in a field."""
    if entry.default_factory is MISSING:
        return entry.name if entry.init else f"given[{entry.name!r}].default"
    made = f"given[{entry.name!r}].default_factory()"
    return f"{made} if {entry.name} is MISSING else {entry.name}" if entry.init else made


def _read_only(function: Any) -> Any:
    """The function of a cached property, changed to return read-only arrays."""

    @wraps(function)
    def computed(self: object) -> Any:
        result = function(self)
        freeze(result)
        return result

    computed.freezes = True  # type: ignore[attr-defined]
    return computed


def _equal(self: Any, other: object) -> Any:
    if type(other) is not type(self):
        return NotImplemented
    return self is other or _key(self) == _key(other)


def _hash(self: Any) -> int:
    return hash(_key(self))


def _held(self: Any) -> dict[str, Any]:
    return {entry.name: getattr(self, entry.name) for entry in fields(self)}


def _state(self: Any) -> dict[str, Any]:
    return {
        name: UsersFunction(f"{type(self).__name__}.{name}", value)
        if isinstance(value, FunctionType)
        else value
        for name, value in _held(self).items()
    }


def _restore(self: Any, state: dict[str, Any]) -> None:
    freeze(state)
    self.__dict__.update(state)


def _copy(self: Any, memo: object = None) -> Any:
    copied = object.__new__(type(self))
    copied.__dict__.update(_held(self))
    return copied


class UsersFunction:
    """A function in the pickled state of a value, with the name of the field that holds it.

    Pickle finds a function by its name. Where it does not, a copy of the function is handed to it under a
    name that says which argument it refuses and why: its message contains the name. cloudpickle takes the
    copy by value, and the name is put back when it is loaded.
    """

    def __init__(self, argument: str, function: FunctionType) -> None:
        self.argument, self.function = argument, function

    def __reduce__(self) -> tuple[Any, ...]:
        function = self.function
        found: object = sys.modules.get(function.__module__)
        for part in function.__qualname__.split("."):
            found = getattr(found, part, None)
        return renamed, (function if found is function else self._explained(), function.__qualname__)

    def _explained(self) -> FunctionType:
        given = self.function
        copied = FunctionType(
            given.__code__, given.__globals__, given.__name__, given.__defaults__, given.__closure__
        )
        copied.__dict__.update(given.__dict__)
        copied.__kwdefaults__, copied.__module__ = given.__kwdefaults__, given.__module__
        copied.__qualname__ = f"{self.argument}: pickle takes no lambda or inner function, cloudpickle does"
        return copied


def renamed(function: FunctionType, name: str) -> FunctionType:
    """The function under its qualified name, which `UsersFunction` replaced."""
    if function.__qualname__ != name:
        function.__qualname__, function.__name__ = name, name.rpartition(".")[2]
    return function


def _key(value: Any) -> Any:
    """A hashable object that two values share if and only if they are equal."""
    if isinstance(value, np.ndarray):
        return _array_key(value)
    if isinstance(value, list | tuple):
        return tuple(map(_key, value))
    if isinstance(value, Mapping):
        return frozenset((_key(name), _key(entry)) for name, entry in value.items())
    if isinstance(value, partial):
        return partial, value.func, _key(value.args), _key(value.keywords)
    if is_dataclass(value) and not isinstance(value, type):
        return type(value), *(_key(getattr(value, x.name)) for x in fields(value) if x.compare)
    if isinstance(value, float | np.floating) and value != value:
        return NAN
    if hasattr(value, "as_immutable"):  # a matrix of SymPy
        return value.as_immutable()
    return value


def _array_key(array: NDArray[Any]) -> Any:
    """Shape, type and entries of an array, with -0.0 taken as 0.0 and every nan as the same nan."""
    if array.dtype.kind == "O":
        return array.shape, tuple(map(_key, array.ravel().tolist()))
    if array.dtype.kind in "fc":
        array = np.where(np.isnan(array), np.nan, array) + 0.0
    return array.shape, array.dtype.str, array.tobytes()
