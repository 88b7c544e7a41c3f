"""Native code that integrates one system of equations: its right-hand sides and the loop around them.

The right-hand sides are recorded on a `Tape` and compiled by LLVM in some 50 ms, `arc_loop` by Numba in some
seconds. Both happen once per machine: `object_code` keeps what is made, and later processes open it in less
than a millisecond, without Numba.
"""

import ctypes
import threading
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache, lru_cache
from itertools import accumulate, pairwise
from pathlib import Path
from typing import Any

import numpy as np

from pontryagin.arrays import Array
from pontryagin.numerics import arc_loop, assembly, dop853, object_code, runge_kutta
from pontryagin.numerics.closure import Closure, closure_of
from pontryagin.numerics.equations import Equations
from pontryagin.numerics.native import compiled_text
from pontryagin.numerics.object_code import Opened
from pontryagin.numerics.tape import Tape

_LOCK = threading.Lock()
"""Held while native code is opened or made, so that threads that start together make it once."""


@dataclass(frozen=True)
class ArcEnd:
    """How an arc ended.

    Attributes
    ----------
    code : int
        0 at the end, otherwise `EVENT`, `SHORT` or `MANY` of `arc_loop`.
    time : float
        The time reached.
    whole : array
        The states there, followed by the rows of their derivatives if these were integrated.
    event : int
        The event that ended the arc, -1 for none.
    steps : int
        Number of steps.
    rows : (k, n) array
        The states at the times of the samples that were reached.
    """

    code: int
    time: float
    whole: Array
    event: int
    steps: int
    rows: Array


@dataclass(frozen=True)
class Compiled:
    """The native right-hand sides of some equations.

    Attributes
    ----------
    rates, directions, guards : int
        Addresses of the rates of n states, of the same with those of m derivatives, and of the event
        functions with their slopes along the trajectory.
    states, columns, width, events, parameters : int
        n, m, numbers that a row of derivatives has room for, how many event functions there are, and how many
        parameters they need.
    code : object
        What keeps the code in memory.
    """

    rates: int
    directions: int
    guards: int
    states: int
    columns: int
    width: int
    events: int
    parameters: int
    code: object

    def follow(
        self,
        whole: Array,
        begin: float,
        end: float,
        parameters: Array,
        tolerance: float,
        longest: float,
        most: int,
        times: Array,
    ) -> ArcEnd:
        """Integrate to the end or to an event; see `arc_loop.follow`."""
        n, moved = self.states, len(whole) > self.states
        size = n * (1 + self.width) if moved else n
        counted, events, samples = len(whole), self.events, len(times)
        if counted not in (n, n * (1 + self.columns)) or len(parameters) < self.parameters:
            raise ValueError(
                f"a trajectory takes {n} states, with {n * self.columns} derivatives or none, and "
                f"{self.parameters} parameters, got {counted} numbers and {len(parameters)} parameters"
            )
        places = _places(n, size, events, samples, len(parameters))
        room = np.zeros(places[-1])
        y, _, _, _, _, _, report, grid, rows, given = (room[a:b] for a, b in pairwise(places))
        y[:n], report[0], grid[:], given[:] = whole[:n], begin, times, parameters
        if moved:
            table = y[n:].reshape(n, self.width)[:, : self.columns]
            table[:] = whole[n:].reshape(n, self.columns)
        base = room.ctypes.data
        at = [base + 8 * place for place in places]
        code = _loop().follow(
            self.directions if moved else self.rates,
            self.rates,
            self.guards,
            events,
            size,
            counted,
            at[0],
            at[9],
            end,
            longest,
            tolerance,
            most,
            at[7],
            samples,
            n,
            at[8],
            at[1],
            at[2],
            TABLE_AT,
            *at[3:7],
        )
        reached = np.concatenate([y[:n], table.ravel()]) if moved else y.copy()
        time, steps, event, done = report.tolist()
        return ArcEnd(
            code, time, reached, int(event), int(steps), rows.reshape(samples, n)[: int(done)].copy()
        )


@lru_cache(maxsize=1024)
def _places(n: int, size: int, events: int, samples: int, parameters: int) -> tuple[int, ...]:
    """Where the parts of the room for one arc begin, and where the last one ends."""
    parts = (size, 13 * size, 12 * n, size, size, 6 * events, 4, samples, samples * n, parameters)
    return (0, *accumulate(parts))


def row_width(columns: int) -> int:
    """Room for a row of derivatives: as many numbers as the processor's vectors hold, or a multiple."""
    return columns if columns <= 2 else 4 * -(-columns // 4)


@lru_cache(maxsize=256)
def compiled(equations: Equations) -> Compiled:
    """The native right-hand sides of some equations, opened or made."""
    n, m = equations.identity.shape
    width, events = row_width(m), equations.events
    symbols = ["rates", *(["directions"] if m else []), *(["guards"] if events else [])]
    text, parameters = right_hand_sides(equations)
    opened = native_text(text, symbols)
    at = dict(zip(symbols, opened.addresses, strict=True))
    addresses = (at["rates"], at.get("directions", 0), at.get("guards", 0))
    return Compiled(*addresses, n, m, width, events, parameters, opened)


def native_text(text: str, symbols: Sequence[str]) -> Opened:
    """The functions of LLVM's text in native code that is opened or made."""
    path = object_code.kept_path(text, object_code.instructions())
    with _LOCK:
        opened = object_code.kept(path, symbols)
        if opened is None:
            opened = object_code.store(object_code.object_code([text], symbols, vectors=True), path, symbols)
    return opened


def right_hand_sides(equations: Equations) -> tuple[str, int]:
    """Rates, derivatives and event functions as LLVM's text, and how many parameters they read."""
    tape = Tape()
    n, m = equations.identity.shape
    states = [tape.record("state", i) for i in range(n)]
    rates, events = equations.record(tape)
    text = assembly.declarations() + assembly.function("rates", tape, n, rates)
    if m:
        columns = [tape.record("column", i, vector=True) for i in range(n)]
        directions = tape.derivatives(rates, dict(zip(states, columns, strict=True)))
        text += assembly.function("directions", tape, n, rates, directions, row_width(m))
    if events:
        along = dict(zip(states, rates, strict=True)) | {tape.record("time"): tape.number(1.0)}
        text += assembly.function("guards", tape, n, [*events, *tape.derivatives(events, along)])
    used = (operation[1] for operation in tape.operations if operation[0] == "parameter")
    return text, 1 + max(used, default=-1)


def table() -> Array:
    """The coefficients in the order of `runge_kutta`: c, the rows of A, b, both estimates of the error."""
    rows = np.zeros((runge_kutta.THIRD + 1, 2, runge_kutta.STAGES))
    everything = (*dop853.STAGES, dop853.STEP, dop853.FIFTH, dop853.THIRD)
    for (weights, stages), given in zip(rows, everything, strict=True):
        weights[: len(given)] = list(given.values())
        stages[: len(given)] = list(given)
    return np.concatenate([dop853.NODES, rows.ravel()])


TABLE = table()
TABLE_AT = TABLE.ctypes.data


@cache
def _loop() -> "Loop":
    """`arc_loop.follow` in native code."""
    return native_loop(arc_loop.follow, ARGUMENTS, {"evaluate": _by_address})


ARGUMENTS = (*["i64"] * 6, *["ptr"] * 2, *["double"] * 3, "i64", "ptr", *["i64"] * 2, *["ptr"] * 8)
"""The types of the arguments of `arc_loop.follow`; functions are given by their addresses."""


@dataclass(frozen=True)
class Loop:
    """A loop over steps in native code.

    Attributes
    ----------
    follow : function
        The loop; functions are given to it by their addresses.
    code : object
        What keeps the code in memory.
    """

    follow: Any
    code: object


def native_loop(
    loop: Callable[..., int], arguments: Sequence[str], replaced: Mapping[str, Callable[[], Any]]
) -> Loop:
    """A loop over steps, given by its plain source, in native code that is opened or made.

    Parameters
    ----------
    loop : function
        The plain source.
    arguments : sequence of str
        The types of its arguments: i64, double or ptr.
    replaced : mapping of str to function
        What Numba takes for a function of that name.
    """
    closure = closure_of(loop)
    path = object_code.kept_path(closure.identity, object_code.instructions())
    with _LOCK:
        opened = object_code.kept(path, ["follow"]) or _made_loop(closure, path, arguments, replaced)
    kinds: dict[str, Any] = {"i64": ctypes.c_int64, "double": ctypes.c_double, "ptr": ctypes.c_void_p}
    kind = ctypes.CFUNCTYPE(ctypes.c_int64, *(kinds[name] for name in arguments))
    return Loop(kind(opened.addresses[0]), opened)


def _made_loop(
    closure: Closure, path: Path, arguments: Sequence[str], replaced: Mapping[str, Callable[[], Any]]
) -> Opened:
    """The loop, compiled by Numba."""
    from numba import types

    pointer: Any = types.CPointer
    numbers = pointer(types.float64)
    kinds = {"i64": types.int64, "double": types.float64, "ptr": numbers}
    signature = types.int64(*(kinds[name] for name in arguments))
    name, text = compiled_text(closure, signature, {of: made() for of, made in replaced.items()})
    taken = ", ".join(f"{kind} %a{i}" for i, kind in enumerate(arguments))
    around = (
        f"declare i32 @{name}(ptr, ptr, {', '.join(arguments)})\n"
        f"define i64 @follow({taken}) {{\n"
        "  %result = alloca i64\n"
        "  %exception = alloca ptr\n"
        f"  %status = call i32 @{name}(ptr %result, ptr %exception, {taken})\n"
        "  %value = load i64, ptr %result\n"
        "  ret i64 %value\n}\n"
    )
    code = object_code.object_code([text, around], ["follow"], vectors=True)
    return object_code.store(code, path, ["follow"])


def _by_address() -> Any:
    """`runge_kutta.evaluate` for Numba: a call of the address that stands for the function."""
    from llvmlite import ir
    from numba import types
    from numba.extending import intrinsic

    @intrinsic
    def evaluate(
        context: Any, function: Any, t: Any, x: Any, x_at: Any, p: Any, out: Any, out_at: Any
    ) -> Any:
        def emit(target_context: Any, builder: Any, _: Any, given: Any) -> Any:
            address, time, states, states_at, values, target, target_at = given
            real = ir.DoubleType()
            kind = ir.FunctionType(ir.VoidType(), [real, *[real.as_pointer()] * 3])
            called = builder.inttoptr(address, kind.as_pointer())
            pointers = (builder.gep(states, [states_at]), values, builder.gep(target, [target_at]))
            builder.call(called, [time, *pointers])
            return target_context.get_dummy_value()

        return types.void(function, t, x, x_at, p, out, out_at), emit

    return evaluate
