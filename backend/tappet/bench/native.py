"""Calling native code in a native loop, so that Python is not measured with it."""

from __future__ import annotations

import ctypes
import shutil
import subprocess
import tempfile
import time
from pathlib import Path

import llvmlite.binding as llvm

_LOOP = """
define void @tappet_bench_loop(ptr %function, i64 %count) {
entry:
  br label %loop
loop:
  %i = phi i64 [ 0, %entry ], [ %next, %loop ]
  call void %function()
  %next = add i64 %i, 1
  %done = icmp sge i64 %next, %count
  br i1 %done, label %exit, label %loop
exit:
  ret void
}
define void @tappet_bench_nothing() {
  ret void
}
"""


class NativeLoop:
    """Calls a `void()` a given number of times from native code."""

    def __init__(self) -> None:
        llvm.initialize_native_target()
        llvm.initialize_native_asmprinter()
        machine = llvm.Target.from_default_triple().create_target_machine(opt=2, jit=True)
        self._jit = llvm.create_lljit_compiler(machine)
        library = (
            llvm.JITLibraryBuilder()
            .add_ir(_LOOP)
            .export_symbol("tappet_bench_loop")
            .export_symbol("tappet_bench_nothing")
            .link(self._jit, "tappet_bench")
        )
        self._library = library
        self._loop = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_int64)(library["tappet_bench_loop"])
        self._nothing = library["tappet_bench_nothing"]

    def seconds(self, function: int, count: int) -> float:
        """Processor time of `count` calls, the time of as many empty calls taken off."""
        empty = self._time(self._nothing, count)
        return max(self._time(function, count) - empty, 0.0)

    def _time(self, function: int, count: int) -> float:
        start = time.thread_time_ns()
        self._loop(function, count)
        return (time.thread_time_ns() - start) * 1e-9


class CProgram:
    """A C file with `void cycle(void)` and `double result`, compiled by gcc -O2."""

    def __init__(self, source: Path, directory: Path) -> None:
        gcc = shutil.which("gcc")
        if gcc is None:
            raise FileNotFoundError("gcc is not installed; the C baseline needs it")
        library = directory / f"{source.stem}.so"
        command = [gcc, "-O2", "-shared", "-fPIC", "-o", str(library), str(source), "-lm"]
        subprocess.run(command, check=True, capture_output=True)  # noqa: S603 - our own file and arguments
        self._load(library)

    @classmethod
    def compiled(cls, library: Path) -> CProgram:
        """The same of a shared library that was made in another way."""
        program = cls.__new__(cls)
        program._load(library)
        return program

    def _load(self, library: Path) -> None:
        self._library = ctypes.CDLL(str(library))
        self.cycle = ctypes.cast(self._library.cycle, ctypes.c_void_p).value or 0

    @property
    def result(self) -> float:
        """Checksum after the cycles so far."""
        return ctypes.c_double.in_dll(self._library, "result").value


def scratch_directory() -> tempfile.TemporaryDirectory[str]:
    """Where baselines are compiled."""
    return tempfile.TemporaryDirectory(prefix="tappet-bench-")


def gcc_version() -> str | None:
    """First line of `gcc --version`, None without gcc."""
    gcc = shutil.which("gcc")
    if gcc is None:
        return None
    done = subprocess.run([gcc, "--version"], check=True, capture_output=True, text=True)  # noqa: S603
    return done.stdout.splitlines()[0]
