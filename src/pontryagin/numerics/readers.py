"""Functions that read numbers from Python objects, as LLVM's text: what `fastcall` is made of."""

import ctypes

TYPE = object.__basicsize__ - ctypes.sizeof(ctypes.c_void_p)
"""Where CPython keeps the type of an object: in the last word of its head."""

NAME = object.__basicsize__ + ctypes.sizeof(ctypes.c_ssize_t)
"""Where CPython keeps the name of a type: next to the head of an object of variable size."""

VALUES = ("PyFloat_Type", "PyLong_Type", "PyList_Type", "PyTuple_Type", "PyBytes_Type", "_Py_NoneStruct")
"""The objects of CPython that the wrapper compares with or returns."""

FUNCTIONS = {
    "PyFloat_AsDouble": "double (ptr)",
    "PyLong_AsDouble": "double (ptr)",
    "PyErr_Occurred": "ptr ()",
    "PyErr_Clear": "void ()",
    "PyType_IsSubtype": "i32 (ptr, ptr)",
    "PyList_Size": "i64 (ptr)",
    "PyList_GetItem": "ptr (ptr, i64)",
    "PyTuple_Size": "i64 (ptr)",
    "PyTuple_GetItem": "ptr (ptr, i64)",
    "PyObject_GetBuffer": "i32 (ptr, ptr, i32)",
    "PyBuffer_Release": "void (ptr)",
    "PyBytes_FromStringAndSize": "ptr (ptr, i64)",
    "PyBytes_AsString": "ptr (ptr)",
    "PyBytes_Size": "i64 (ptr)",
    "Py_IncRef": "void (ptr)",
}
"""The functions of CPython that the wrapper calls, with their types; all are part of its stable interface."""

READERS = """
declare i32 @strcmp(ptr, ptr)
declare void @llvm.memcpy.p0.p0.i64(ptr, ptr, i64, i1)
@doubles = private constant [2 x i8] c"d\\00"
@plain = private constant [14 x i8] c"numpy.ndarray\\00"

; A float, an instance of a subclass such as numpy.float64, or an integer that fits.
define internal i1 @number(ptr %object, ptr %target) {
  %place = getelementptr i8, ptr %object, i64 TYPE
  %type = load ptr, ptr %place
  %is_float = icmp eq ptr %type, @PyFloat_Type
  br i1 %is_float, label %float, label %other
other:
  %is_int = icmp eq ptr %type, @PyLong_Type
  br i1 %is_int, label %int, label %neither
neither:
  %subtype = call i32 @PyType_IsSubtype(ptr %type, ptr @PyFloat_Type)
  %is_kin = icmp ne i32 %subtype, 0
  br i1 %is_kin, label %float, label %no
float:
  %real = call double @PyFloat_AsDouble(ptr %object)
  store double %real, ptr %target
  ret i1 true
int:
  %whole = call double @PyLong_AsDouble(ptr %object)
  store double %whole, ptr %target
  %error = call ptr @PyErr_Occurred()
  %fits = icmp eq ptr %error, null
  br i1 %fits, label %yes, label %too_large
too_large:
  call void @PyErr_Clear()
  ret i1 false
yes:
  ret i1 true
no:
  ret i1 false
}

; A plain array of doubles, of no axis or of one axis of the given length. Arrays of other types, which may
; carry a mask or a unit, are left to Python.
define internal i1 @array(ptr %object, i32 %axes, i64 %size, ptr %target) {
  %view = alloca [10 x i64], align 8
  %place = getelementptr i8, ptr %object, i64 TYPE
  %type = load ptr, ptr %place
  %name_at = getelementptr i8, ptr %type, i64 NAME
  %name = load ptr, ptr %name_at
  %differs = call i32 @strcmp(ptr %name, ptr @plain)
  %is_plain = icmp eq i32 %differs, 0
  br i1 %is_plain, label %opened, label %other
other:
  ret i1 false
opened:
  %failed = call i32 @PyObject_GetBuffer(ptr %object, ptr %view, i32 28)
  %has_none = icmp ne i32 %failed, 0
  br i1 %has_none, label %refused, label %held
refused:
  call void @PyErr_Clear()
  ret i1 false
held:
  %data = load ptr, ptr %view
  %axes_at = getelementptr i8, ptr %view, i64 36
  %has_axes = load i32, ptr %axes_at
  %axes_fit = icmp eq i32 %has_axes, %axes
  %format_at = getelementptr i8, ptr %view, i64 40
  %format = load ptr, ptr %format_at
  %order = call i32 @strcmp(ptr %format, ptr @doubles)
  %format_fits = icmp eq i32 %order, 0
  %fits = and i1 %axes_fit, %format_fits
  br i1 %fits, label %chosen, label %no
chosen:
  %flat = icmp eq i32 %axes, 0
  br i1 %flat, label %alone, label %row
alone:
  %only = load double, ptr %data, align 1
  store double %only, ptr %target
  br label %yes
row:
  %shape_at = getelementptr i8, ptr %view, i64 48
  %shape = load ptr, ptr %shape_at
  %length = load i64, ptr %shape
  %strides_at = getelementptr i8, ptr %view, i64 56
  %strides = load ptr, ptr %strides_at
  %stride = load i64, ptr %strides
  %size_fits = icmp eq i64 %length, %size
  br i1 %size_fits, label %copy, label %no
copy:
  %i = phi i64 [0, %row], [%next, %copy]
  %offset = mul i64 %i, %stride
  %from = getelementptr i8, ptr %data, i64 %offset
  %entry = load double, ptr %from, align 1
  %to = getelementptr double, ptr %target, i64 %i
  store double %entry, ptr %to
  %next = add i64 %i, 1
  %more = icmp slt i64 %next, %size
  br i1 %more, label %copy, label %yes
yes:
  call void @PyBuffer_Release(ptr %view)
  ret i1 true
no:
  call void @PyBuffer_Release(ptr %view)
  ret i1 false
}

define internal i1 @scalar(ptr %object, i64 %size, ptr %target) {
  %plain = call i1 @number(ptr %object, ptr %target)
  br i1 %plain, label %yes, label %other
yes:
  ret i1 true
other:
  %read = call i1 @array(ptr %object, i32 0, i64 1, ptr %target)
  ret i1 %read
}

; A list, a tuple or an array of the given length.
define internal i1 @vector(ptr %object, i64 %size, ptr %target) {
  %place = getelementptr i8, ptr %object, i64 TYPE
  %type = load ptr, ptr %place
  %is_list = icmp eq ptr %type, @PyList_Type
  br i1 %is_list, label %list, label %other
list:
  %in_list = call i64 @PyList_Size(ptr %object)
  br label %sized
other:
  %is_tuple = icmp eq ptr %type, @PyTuple_Type
  br i1 %is_tuple, label %tuple, label %neither
neither:
  %read = call i1 @array(ptr %object, i32 1, i64 %size, ptr %target)
  ret i1 %read
tuple:
  %in_tuple = call i64 @PyTuple_Size(ptr %object)
  br label %sized
sized:
  %length = phi i64 [%in_list, %list], [%in_tuple, %tuple]
  %get = phi ptr [@PyList_GetItem, %list], [@PyTuple_GetItem, %tuple]
  %fits = icmp eq i64 %length, %size
  br i1 %fits, label %entry, label %no
entry:
  %i = phi i64 [0, %sized], [%next, %following]
  %item = call ptr %get(ptr %object, i64 %i)
  %to = getelementptr double, ptr %target, i64 %i
  %taken = call i1 @number(ptr %item, ptr %to)
  br i1 %taken, label %following, label %no
following:
  %next = add i64 %i, 1
  %more = icmp slt i64 %next, %size
  br i1 %more, label %entry, label %yes
yes:
  ret i1 true
no:
  ret i1 false
}

; The last numbers of the bytes that another wrapper returned, or a vector.
define internal i1 @packed(ptr %object, i64 %size, ptr %target) {
  %place = getelementptr i8, ptr %object, i64 TYPE
  %type = load ptr, ptr %place
  %is_bytes = icmp eq ptr %type, @PyBytes_Type
  br i1 %is_bytes, label %bytes, label %other
bytes:
  %length = call i64 @PyBytes_Size(ptr %object)
  %wanted = mul i64 %size, 8
  %start = sub i64 %length, %wanted
  %holds = icmp sge i64 %start, 0
  br i1 %holds, label %copy, label %no
copy:
  %text = call ptr @PyBytes_AsString(ptr %object)
  %from = getelementptr i8, ptr %text, i64 %start
  call void @llvm.memcpy.p0.p0.i64(ptr %target, ptr %from, i64 %wanted, i1 false)
  ret i1 true
other:
  %read = call i1 @vector(ptr %object, i64 %size, ptr %target)
  ret i1 %read
no:
  ret i1 false
}

; Where the doubles of a `bytes` object lie.
define internal ptr @table(ptr %object) {
  %place = getelementptr i8, ptr %object, i64 TYPE
  %type = load ptr, ptr %place
  %is_bytes = icmp eq ptr %type, @PyBytes_Type
  br i1 %is_bytes, label %bytes, label %no
bytes:
  %data = call ptr @PyBytes_AsString(ptr %object)
  ret ptr %data
no:
  ret ptr null
}
""".replace("TYPE", str(TYPE)).replace("NAME", str(NAME))
"""Functions (object, size, target) that store the numbers of an object; false if it does not hold them. And
`table`, which gives the address of a table, or null."""


def declarations() -> str:
    """The functions and objects of CPython that the readers and the wrapper use, declared."""
    lines = [f"@{name} = external global i8" for name in VALUES]
    for name, kind in FUNCTIONS.items():
        returned, taken = kind.split(" ", 1)
        lines.append(f"declare {returned} @{name}{taken}")
    return "\n".join(lines)


def addresses() -> dict[str, int]:
    """Where the functions and objects of `declarations` lie in this process."""
    places = {name: ctypes.addressof(ctypes.c_char.in_dll(ctypes.pythonapi, name)) for name in VALUES}
    for name in FUNCTIONS:
        places[name] = ctypes.cast(getattr(ctypes.pythonapi, name), ctypes.c_void_p).value or 0
    return places
