"""Links a code package into the process of a test, beside the runtime: for single functions and their faults.

Faults come back as `ApplicationFault`; signals (null pointers, endless loops) are not caught here. The clock
is virtual and moved by hand.
"""

from __future__ import annotations

import ctypes
import itertools
import mmap
from collections.abc import Iterator
from contextlib import contextmanager

import llvmlite.binding as llvm

from tappet.codegen.compile_options import OptimiseOptions
from tappet.codegen.faults import fault_message
from tappet.codegen.optimise import compile_text, target_machine
from tappet.codegen.package import EXIT_SYMBOL, INIT_SYMBOL, CodePackage
from tappet.codegen.values import Value

SUPPORT = r"""
@tappet.jump = internal global [512 x i8] zeroinitializer, align 16
@tappet.target = internal global ptr @tappet.jump, align 8
@tappet.fault = global [4 x i64] zeroinitializer, align 8
@tappet.clock = global i64 0, align 8
declare i32 @_setjmp(ptr) returns_twice
declare void @longjmp(ptr, i32) noreturn
define void @tappet_fault(i32 %code, i64 %a, i64 %b, i64 %c) noreturn {
  %wide = zext i32 %code to i64
  store i64 %wide, ptr @tappet.fault
  store i64 %a, ptr getelementptr (i8, ptr @tappet.fault, i64 8)
  store i64 %b, ptr getelementptr (i8, ptr @tappet.fault, i64 16)
  store i64 %c, ptr getelementptr (i8, ptr @tappet.fault, i64 24)
  call void @tappet.leave(i32 %code)
  unreachable
}
define void @tappet_keep_fault(i64 %record) {
  %place = inttoptr i64 %record to ptr
  call void @llvm.memcpy.p0.p0.i64(ptr %place, ptr @tappet.fault, i64 32, i1 false)
  ret void
}
define void @tappet_rethrow(i32 %code, i64 %record) noreturn {
  %place = inttoptr i64 %record to ptr
  call void @llvm.memcpy.p0.p0.i64(ptr @tappet.fault, ptr %place, i64 32, i1 false)
  call void @tappet.leave(i32 %code)
  unreachable
}
declare void @llvm.memcpy.p0.p0.i64(ptr, ptr, i64, i1)
define internal void @tappet.leave(i32 %code) noreturn {
  %target = load ptr, ptr @tappet.target
  call void @longjmp(ptr %target, i32 %code)
  unreachable
}
define i64 @tappet_guard(i64 %buffer) {
  %before = load i64, ptr @tappet.target
  store i64 %buffer, ptr @tappet.target
  ret i64 %before
}
define i32 @tappet_exception_code(i32 %code) {
  switch i32 %code, label %unknown [
    i32 1, label %division
    i32 2, label %bounds
    i32 3, label %access
    i32 4, label %access
    i32 9, label %user
    i32 10, label %access
    i32 11, label %access
  ]
division:
  ret i32 258
bounds:
  ret i32 257
access:
  ret i32 81
user:
  ret i32 65536
unknown:
  ret i32 -1
}
declare ptr @calloc(i64, i64)
declare void @free(ptr)
define ptr @tappet_allocate(i64 %count, i64 %size) {
  %negative = icmp ugt i64 %count, 281474976710655
  br i1 %negative, label %none, label %ask
ask:
  %more = add i64 %size, 15
  %elements = udiv i64 %more, %size
  %room = add i64 %count, %elements
  %head = call ptr @calloc(i64 %room, i64 %size)
  %failed = icmp eq ptr %head, null
  br i1 %failed, label %none, label %got
got:
  store i64 %count, ptr %head
  %second = getelementptr i8, ptr %head, i64 8
  store i64 %size, ptr %second
  %memory = getelementptr i8, ptr %head, i64 16
  ret ptr %memory
none:
  ret ptr null
}
define void @tappet_release(ptr %memory) {
  %head = getelementptr i8, ptr %memory, i64 -16
  call void @free(ptr %head)
  ret void
}
define i64 @tappet_elements(ptr %memory) {
  %head = getelementptr i8, ptr %memory, i64 -16
  %count = load i64, ptr %head
  ret i64 %count
}
define i64 @tappet_element_size(ptr %memory) {
  %second = getelementptr i8, ptr %memory, i64 -8
  %size = load i64, ptr %second
  ret i64 %size
}
define ptr @tappet_set_aside(i64 %size) {
  %memory = call ptr @calloc(i64 1, i64 %size)
  ret ptr %memory
}
define void @tappet_take_back(ptr %memory) {
  call void @free(ptr %memory)
  ret void
}
define i64 @tappet_task_current() {
  ret i64 0
}
define i64 @tappet_now_ns() {
  %now = load i64, ptr @tappet.clock
  ret i64 %now
}
define i64 @tappet_unix_ns() {
  %run = load i64, ptr @tappet.clock
  %now = add i64 %run, 1790000000000000000
  ret i64 %now
}
define i32 @tappet_task_facts(i32 %number, ptr %facts) {
  ret i32 0
}
define i32 @tappet_application_facts(ptr %facts) {
  ret i32 0
}
define i64 @tappet_file_post(i32 %kind, i64 %file, ptr %name, ptr %other, i64 %mode, i64 %count, ptr %data) {
  ret i64 -1
}
define i32 @tappet_file_poll(i64 %ticket, ptr %result, ptr %data, i64 %size) {
  store i64 -1, ptr %result
  ret i32 1
}
define void @tappet_file_leave(i64 %ticket, i64 %left) {
  ret void
}
define void @tappet_file_abandon(i64 %ticket) {
  ret void
}
define i32 @tappet.guard(ptr %function) returns_twice {
  store ptr @tappet.jump, ptr @tappet.target
  %landed = call i32 @_setjmp(ptr @tappet.jump) returns_twice
  %first = icmp eq i32 %landed, 0
  br i1 %first, label %run, label %failed
run:
  call void %function()
  ret i32 0
failed:
  %code = load i64, ptr @tappet.fault
  %short = trunc i64 %code to i32
  ret i32 %short
}
"""
"""Fault trampoline, clock and guarded call, no files; one application at a time per copy."""
SUPPORT_OBJECT = compile_text(SUPPORT, OptimiseOptions(level=1))
"""Made once, before a process for a case is forked."""

_MAP_32BIT = 0x40
_numbers = itertools.count()


class ApplicationFault(Exception):  # noqa: N818 - a fault of the program, no error of this one
    """A fault raised by compiled code."""

    def __init__(self, code: int, a: int, b: int, c: int) -> None:
        super().__init__(fault_message(code, a, b, c))
        self.code = code
        self.args_abc = (a, b, c)


def allocate_low(size: int) -> int:
    """Address of zeroed memory below 2 GiB (MAP_32BIT); raises OSError."""
    libc = ctypes.CDLL(None, use_errno=True)
    libc.mmap.restype = ctypes.c_void_p
    libc.mmap.argtypes = [ctypes.c_void_p, ctypes.c_size_t, *[ctypes.c_int] * 3, ctypes.c_long]
    flags = mmap.MAP_PRIVATE | mmap.MAP_ANONYMOUS | _MAP_32BIT
    address = libc.mmap(None, max(size, 1), mmap.PROT_READ | mmap.PROT_WRITE, flags, -1, 0)
    if address is None or address == ctypes.c_void_p(-1).value:
        raise OSError(ctypes.get_errno(), "no memory below 2 GiB for the data of the application")
    return int(address)


def release(address: int, size: int) -> None:
    """Give memory of `allocate_low` back."""
    libc = ctypes.CDLL(None)
    libc.munmap.argtypes = [ctypes.c_void_p, ctypes.c_size_t]
    libc.munmap(address, max(size, 1))


class LoadedApplication:
    """A package linked into this process with its memory image."""

    def __init__(self, package: CodePackage, address: int = 0) -> None:
        """Link `package`; `address` is memory of another application to work on, which keeps owning it."""
        self.package = package
        self.size = package.image_size + (1 << 16)
        self.owner = not address
        self.address = address or allocate_low(self.size)
        self.image = (ctypes.c_char * self.size).from_address(self.address)
        self._machine = target_machine(OptimiseOptions())
        self._jit = llvm.create_lljit_compiler(self._machine, use_jit_link=True)
        llvm.load_library_permanently("libm.so.6")
        builder = llvm.JITLibraryBuilder().add_current_process()
        builder.add_object_img(SUPPORT_OBJECT)
        for data in package.objects:
            builder.add_object_img(data)
        for symbol, place in package.data_objects.items():
            builder.import_symbol(symbol, self.address + place.offset)
        own = ["tappet.guard", "tappet.fault", "tappet.clock"]
        for name in own + package.exports:
            builder.export_symbol(name)
        self._tracker = builder.link(self._jit, f"application{next(_numbers)}")
        self._guard = ctypes.CFUNCTYPE(ctypes.c_int32, ctypes.c_void_p)(self._tracker["tappet.guard"])
        self._fault = (ctypes.c_int64 * 4).from_address(self._tracker["tappet.fault"])
        self._clock = ctypes.c_int64.from_address(self._tracker["tappet.clock"])
        self.tasks = {t.name: t for t in package.tasks}

    def close(self) -> None:
        """Unlink the code and release the image."""
        if self.address:
            self._tracker.close()
            self._jit.close()
            if self.owner:
                release(self.address, self.size)
            self.address = 0

    @property
    def clock_ns(self) -> int:
        """What TIME() and LTIME() read."""
        return self._clock.value

    @clock_ns.setter
    def clock_ns(self, value: int) -> None:
        self._clock.value = value

    def symbol_address(self, name: str) -> int:
        """Address of an exported function."""
        return int(self._tracker[name])

    def call(self, symbol: str) -> None:
        """Run an exported `void()`; raises ApplicationFault."""
        code = self._guard(self._tracker[symbol])
        if code:
            raise ApplicationFault(code, *self._fault[1:4])

    def start(self) -> None:
        """Cold start: initial image, then the initialisers."""
        ctypes.memmove(self.address, self.package.initial_image, self.package.image_size)
        self.call(INIT_SYMBOL)

    def exit(self) -> None:
        """Call FB_Exit of all instances, if there are any."""
        if EXIT_SYMBOL in self.package.exports:
            self.call(EXIT_SYMBOL)

    def cycle(self, task: str | None = None) -> None:
        """One cycle of a task, or of all in order."""
        for spec in self.package.tasks:
            if task is None or spec.name == task:
                self.call(spec.symbol)

    def read(self, path: str) -> Value:
        """Value of a variable."""
        ref = self.package.symbols.resolve(path)
        data = ctypes.string_at(self.address + ref.offset, ref.size)
        return self.package.symbols.decode(ref, data)

    def literal(self, path: str) -> str:
        """Value of a variable as IEC literal."""
        symbols = self.package.symbols
        ref = symbols.resolve(path)
        data = ctypes.string_at(self.address + ref.offset, ref.size)
        return symbols.format_literal(ref, symbols.decode(ref, data))

    def write(self, path: str, value: Value) -> None:
        """Set a variable."""
        symbols = self.package.symbols
        ref = symbols.resolve(path)
        data = symbols.encode(ref, value)
        if ref.bit is not None:
            old = self.image[ref.offset][0]
            mask = 1 << ref.bit
            data = bytes([old | mask if data[0] else old & ~mask])
        ctypes.memmove(self.address + ref.offset, data, len(data))


@contextmanager
def loaded(package: CodePackage) -> Iterator[LoadedApplication]:
    """A started application that is unlinked at the end."""
    application = LoadedApplication(package)
    try:
        application.start()
        yield application
    finally:
        application.close()
