"""The machine-level wrapper of a scalar kernel: a Python function and a loop over columns, as LLVM's text.

The function has CPython's fastest calling convention, METH_FASTCALL. It reads floats, integers, lists, tuples
and arrays of doubles without NumPy, calls the kernel and returns the numbers read and computed as one `bytes`
object; or None if an argument is anything else or any number is not finite.
"""

import ctypes
from collections.abc import Callable, Sequence

from pontryagin.numerics.readers import READERS, declarations

CALL = """
define ptr @call(ptr %self, ptr %arguments, i64 %count) {{
  %numbers = alloca [{total} x double], align 8
  %exception = alloca ptr
  %enough = icmp eq i64 %count, {arguments}
  br i1 %enough, label %read0, label %no
{reading}
read{arguments}:
{loads}
  %result = getelementptr double, ptr %numbers, i64 {inputs}
  %status = call i32 @{kernel}(ptr %result, ptr %exception, {values})
  %solved = icmp eq i32 %status, 0
  br i1 %solved, label %entry, label %no
entry:
  %i = phi i64 [0, %read{arguments}], [%next, %entry]
  %sum = phi double [0.0, %read{arguments}], [%added, %entry]
  %at = getelementptr double, ptr %numbers, i64 %i
  %number = load double, ptr %at
  %nothing = fmul double %number, 0.0
  %added = fadd double %sum, %nothing
  %next = add i64 %i, 1
  %more = icmp slt i64 %next, {total}
  br i1 %more, label %entry, label %summed
summed:
  %finite = fcmp oeq double %added, 0.0
  br i1 %finite, label %yes, label %no
yes:
  %made = call ptr @PyBytes_FromStringAndSize(ptr %numbers, i64 {size})
  ret ptr %made
no:
  call void @Py_IncRef(ptr @_Py_NoneStruct)
  ret ptr @_Py_NoneStruct
}}
"""
"""The Python function: zero times a number is zero if and only if the number is finite."""

READ = """
read{index}:
  %place{index} = getelementptr ptr, ptr %arguments, i64 {index}
  %object{index} = load ptr, ptr %place{index}
  %target{index} = getelementptr double, ptr %numbers, i64 {offset}
  %taken{index} = call i1 @{reader}(ptr %object{index}, i64 {size}, ptr %target{index})
  br i1 %taken{index}, label %read{following}, label %no
"""

HELD = """
  %held{i} = getelementptr double, ptr %numbers, i64 {i}
  %value{i} = load double, ptr %held{i}
"""
"""One input among the numbers read."""

COLUMN = """
  %column_at{i} = getelementptr ptr, ptr %columns, i64 {i}
  %column{i} = load ptr, ptr %column_at{i}
  %stride_at{i} = getelementptr i64, ptr %strides, i64 {i}
  %stride{i} = load i64, ptr %stride_at{i}
"""
"""The start and the stride of one column."""

SHARED = """
read{index}:
  %place{index} = getelementptr ptr, ptr %arguments, i64 {index}
  %object{index} = load ptr, ptr %place{index}
  %table{index} = call ptr @table(ptr %object{index})
  %taken{index} = icmp ne ptr %table{index}, null
  br i1 %taken{index}, label %read{following}, label %no
"""
"""A table among the arguments of the Python function."""

COLUMN_OF_TABLE = """
  %table_at{i} = getelementptr ptr, ptr %columns, i64 {i}
  %table{i} = load ptr, ptr %table_at{i}
"""
"""A table among the columns, which all problems share."""

ENTRY = """
  %offset{i} = mul i64 %i, %stride{i}
  %entry{i} = getelementptr i8, ptr %column{i}, i64 %offset{i}
  %value{i} = load double, ptr %entry{i}, align 1
"""
"""One input of one problem of a stack."""

LOOP = """
define i32 @loop(ptr %result, i64 %count, ptr %columns, ptr %strides) {{
  %exception = alloca ptr
{columns}
  br label %head
head:
  %i = phi i64 [0, %0], [%next, %body]
  %more = icmp slt i64 %i, %count
  br i1 %more, label %body, label %end
body:
{loads}
  %place = mul i64 %i, {outputs}
  %row = getelementptr double, ptr %result, i64 %place
  %status = call i32 @{kernel}(ptr %row, ptr %exception, {values})
  %next = add i64 %i, 1
  %solved = icmp eq i32 %status, 0
  br i1 %solved, label %head, label %failed
failed:
  ret i32 %status
end:
  ret i32 0
}}
"""
"""The loop over a stack: problem i takes the number at column + i * stride, in bytes, of each column."""


def wrapper(kernel: str, groups: Sequence[int], outputs: int, packed: bool, tables: int = 0) -> str:
    """The text of a module with ``call`` and ``loop`` around a kernel that Numba compiled.

    Parameters
    ----------
    kernel : str
        The kernel's name: a function (result, exception, numbers ...) that returns 0 where it succeeds.
    groups : sequence of int
        How many numbers each argument of the Python function holds; 1 stands for a number by itself.
    outputs : int
        Number of results.
    packed : bool
        Whether an argument may also be the `bytes` that end with its numbers.
    tables : int
        How many arguments follow that are tables: `bytes` of doubles, of which the kernel gets the address.
    """
    inputs, total = sum(groups), sum(groups) + outputs
    shared = range(len(groups), len(groups) + tables)
    reading = "".join(
        READ.format(
            index=i,
            following=i + 1,
            offset=sum(groups[:i]),
            size=size,
            reader="packed" if packed else "scalar" if size == 1 else "vector",
        )
        for i, size in enumerate(groups)
    )
    reading += "".join(SHARED.format(index=i, following=i + 1) for i in shared)
    values = ", ".join(f"double %value{i}" for i in range(inputs))
    common = {"kernel": kernel, "values": values, "outputs": outputs, "inputs": inputs}
    call = CALL.format(
        **common | {"values": ", ".join([values, *(f"ptr %table{i}" for i in shared)])},
        arguments=len(groups) + tables,
        reading=reading,
        loads="".join(HELD.format(i=i) for i in range(inputs)),
        total=total,
        size=8 * total,
    )
    last = range(inputs, inputs + tables)
    columns = [COLUMN.format(i=i) for i in range(inputs)] + [COLUMN_OF_TABLE.format(i=i) for i in last]
    loop = LOOP.format(
        **common | {"values": ", ".join([values, *(f"ptr %table{i}" for i in last)])},
        columns="".join(columns),
        loads="".join(ENTRY.format(i=i) for i in range(inputs)),
    )
    declared = f"declare i32 @{kernel}(ptr, ptr, {', '.join(['double'] * inputs + ['ptr'] * tables)})\n"
    return declared + declarations() + READERS + call + loop


class _Method(ctypes.Structure):
    """CPython's PyMethodDef."""

    _fields_ = (
        ("name", ctypes.c_char_p),
        ("address", ctypes.c_void_p),
        ("flags", ctypes.c_int),
        ("doc", ctypes.c_char_p),
    )


METH_FASTCALL = 0x80
_ALIVE: list[_Method] = []
"""The definitions of the functions made, which CPython refers to and does not copy."""


def python_function(name: str, address: int) -> Callable[..., bytes | None]:
    """The Python function whose ``call`` lies at an address."""
    method = _Method(name.encode(), address, METH_FASTCALL, None)
    _ALIVE.append(method)
    make = ctypes.pythonapi.PyCFunction_NewEx
    make.restype, make.argtypes = ctypes.py_object, [ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p]
    made: Callable[..., bytes | None] = make(ctypes.addressof(method), None, None)
    return made
