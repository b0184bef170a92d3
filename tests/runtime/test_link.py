"""Linking: only permitted symbols, memory given back, addresses found again."""

import ctypes

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tappet.codegen.compile_options import OptimiseOptions
from tappet.codegen.optimise import compile_text
from tappet.runtime.executive.loader import Executive
from tappet.runtime.link import LinkError, read_symbols

TEXT = """
target triple = "x86_64-unknown-linux-gnu"
@"tappet.data.X" = external global i64
declare double @sin(double)
declare i64 @forbidden()
define i64 @count() #0 {
  %old = load i64, ptr @"tappet.data.X"
  %new = add i64 %old, 1
  store i64 %new, ptr @"tappet.data.X"
  ret i64 %new
}
define double @wave(double %x) #0 {
  %y = call double @sin(double %x)
  ret double %y
}
attributes #0 = { "frame-pointer"="all" nounwind }
"""


def object_code(text: str = TEXT) -> bytes:
    return compile_text(text, OptimiseOptions(level=1))


def test_data_and_mathematics_are_resolved() -> None:
    data = ctypes.c_int64(41)
    code = Executive.shared().linker.link(
        [object_code()], ["count", "wave"], {"tappet.data.X": ctypes.addressof(data)}
    )
    assert ctypes.CFUNCTYPE(ctypes.c_int64)(code["count"])() == 42
    assert ctypes.CFUNCTYPE(ctypes.c_double, ctypes.c_double)(code["wave"])(0.0) == 0.0
    section = code.section_of(code["count"])
    assert section is not None
    assert code.section_of(ctypes.addressof(data)) is None
    code.close()


def test_what_llvm_puts_in_place_of_mathematics_is_resolved() -> None:
    """Sine and cosine of one value become one call, of REAL as of LREAL."""
    text = (
        TEXT
        + """
    declare double @cos(double)
    declare float @sinf(float)
    declare float @cosf(float)
    define double @turn(double %x) #0 {
      %s = call double @sin(double %x)
      %c = call double @cos(double %x)
      %r = fadd double %s, %c
      %y = fptrunc double %x to float
      %sf = call float @sinf(float %y)
      %cf = call float @cosf(float %y)
      %f = fadd float %sf, %cf
      %g = fpext float %f to double
      %sum = fadd double %r, %g
      ret double %sum
    }
    """
    )
    declared = text.replace("(double)\n", "(double) #1\n").replace("(float)\n", "(float) #1\n")
    content = object_code(declared + "attributes #1 = { nounwind willreturn memory(none) }")
    undefined = {symbol.name for symbol in read_symbols(content)[0]}
    assert {"sincos", "sincosf"} <= undefined
    code = Executive.shared().linker.link([content], ["turn"], {"tappet.data.X": 4096})
    assert ctypes.CFUNCTYPE(ctypes.c_double, ctypes.c_double)(code["turn"])(0.0) == 2.0
    code.close()


def test_other_functions_of_the_process_are_refused_by_name() -> None:
    text = TEXT + "define i64 @use() { %v = call i64 @forbidden() \n ret i64 %v }"
    with pytest.raises(LinkError, match="needs 'forbidden', which this runtime does not offer"):
        Executive.shared().linker.link([object_code(text)], ["use"], {"tappet.data.X": 4096})


def test_missing_export_is_named() -> None:
    with pytest.raises(LinkError, match=r"does not define tappet\.init"):
        Executive.shared().linker.link([object_code()], ["tappet.init"], {"tappet.data.X": 4096})


def test_many_links_do_not_grow_the_process() -> None:
    code = object_code()
    linker = Executive.shared().linker

    def resident() -> int:
        with open("/proc/self/statm", encoding="ascii") as file:
            return int(file.read().split()[1]) * 4096

    def rounds(count: int) -> None:
        for _ in range(count):
            linker.link([code], ["count"], {"tappet.data.X": 4096}).close()

    rounds(50)
    before = resident()
    rounds(500)
    assert resident() - before < 12 << 20  # ORC keeps some 8 KiB of names per library


@given(st.binary(max_size=200))
def test_damaged_objects_are_refused(data: bytes) -> None:
    with pytest.raises(LinkError):
        read_symbols(b"\x7fELF\x02\x01" + data[:40])
