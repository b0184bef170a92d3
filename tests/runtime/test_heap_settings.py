"""The settings of the heap of an application: from the options of a build to what __NEW gives."""

from __future__ import annotations

from dataclasses import replace

import pytest
from plc_programs import MAIN

from tappet.codegen.build import BuildOptions, BuildSession, build_application
from tappet.codegen.package import CodePackage
from tappet.iec.heap import KIB, HeapSettings
from tappet.lang.source import Source
from tappet.runtime.errors import PlcError
from tappet.runtime.local import LocalRuntime
from tappet.runtime.unit_tests.order import order
from tappet.runtime.unit_tests.process import run_in_process

TEXT = """PROGRAM PLC_PRG
VAR p, q : POINTER TO DINT; made, refused, seen : DINT; END_VAR
p := __NEW(DINT, 250);
IF p = 0 THEN refused := refused + 1; ELSE made := made + 1; END_IF
q := __NEW(DINT);
IF q <> 0 THEN q^ := 7; p := q; __DELETE(q); seen := p^; END_IF
END_PROGRAM
"""
SMALL, LARGE = HeapSettings(64 * KIB), HeapSettings(256 * KIB)
POISONED = replace(SMALL, poison=True)


def built(
    heap: HeapSettings | None = None,
    previous: CodePackage | None = None,
    session: BuildSession | None = None,
    text: str = TEXT,
) -> CodePackage:
    options = BuildOptions() if heap is None else BuildOptions(heap=heap)
    result = build_application([Source("plc", text, name="plc")], MAIN, options, previous, session)
    assert result.package is not None, [d for d in result.diagnostics if d.severity == "error"]
    return result.package


@pytest.mark.parametrize(
    ("heap", "least", "most"), [(SMALL, 50, 64), (LARGE, 200, 256), (HeapSettings(0), 0, 0)]
)
def test_new_gives_0_beyond_the_limit_of_the_application(heap: HeapSettings, least: int, most: int) -> None:
    with LocalRuntime(built(heap)) as runtime:
        runtime.run(cycles=300)
        made, refused = runtime.read("PLC_PRG.made"), runtime.read("PLC_PRG.refused")
        assert least <= made <= most
        assert made + refused == 300


def test_each_setting_is_a_build_of_its_own() -> None:
    packages = [built(heap) for heap in (None, SMALL, LARGE, POISONED)]
    assert len({package.code_id for package in packages}) == 4
    assert len({package.data_id for package in packages}) == 1
    assert built(SMALL).code_id == packages[1].code_id
    assert built(HeapSettings()).code_id == packages[0].code_id


def test_an_edit_after_a_changed_setting_keeps_it() -> None:
    """Builds of one session make only what changed: the settings are not what was there before."""
    session = BuildSession()
    built(SMALL, session=session)
    assert built(LARGE, session=session).facts.heap_limit == LARGE.limit
    edited = built(LARGE, session=session, text=TEXT.replace("q^ := 7", "q^ := 8"))
    assert edited.facts.heap_limit == LARGE.limit


def test_another_limit_needs_a_download() -> None:
    first = built(SMALL)
    with LocalRuntime(first) as runtime:
        runtime.run(cycles=100)
        made = runtime.read("PLC_PRG.made")
        second = built(LARGE, previous=first)
        with pytest.raises(PlcError, match=r"64 KiB to 256 KiB: download it"):
            runtime.plc.download(second.to_bytes(), "online_change")
        runtime.run(cycles=10)
        assert runtime.read("PLC_PRG.made") == made, "the one that runs keeps its limit"
        runtime.plc.download(second.to_bytes())
        runtime.start()
        runtime.run(cycles=300)
        assert runtime.read("PLC_PRG.made") > 200


def test_an_online_change_fills_what_is_given_back_from_then_on() -> None:
    first = built(SMALL)
    with LocalRuntime(first) as runtime:
        runtime.run(cycles=1)
        assert runtime.read("PLC_PRG.seen") == 7
        second = built(POISONED, previous=first)
        runtime.plc.download(second.to_bytes(), "online_change")
        runtime.run(cycles=1)
        assert runtime.read("PLC_PRG.seen") == -0x22222223
        runtime.plc.download(built(SMALL, previous=second).to_bytes(), "online_change")
        runtime.run(cycles=1)
        assert runtime.read("PLC_PRG.seen") == 7


SUITE = """{attribute 'enable_dynamic_creation'}
FUNCTION_BLOCK Tests EXTENDS FB_TestSuite
METHOD Room
VAR p : POINTER TO BYTE; END_VAR
TEST('Room');
p := __NEW(BYTE, 100_000);
AssertTrue(p <> 0, 'there is room');
__DELETE(p);
TEST_FINISHED();
END_METHOD
Room();
END_FUNCTION_BLOCK
"""


@pytest.mark.parametrize(("heap", "passed"), [(SMALL, 0), (LARGE, 1)])
def test_unit_tests_have_the_heap_of_their_application(heap: HeapSettings, passed: int) -> None:
    options = BuildOptions()
    text = [Source("tests.st", SUITE, name="tests")]
    report = run_in_process(order(options.application, text, [], options.libraries, heap=heap))
    assert (report.total, report.count("passed")) == (1, passed), report
