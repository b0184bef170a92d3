"""Single cycle of a stopped application (LST-84)."""

from collections.abc import Iterator

import pytest
from plc_programs import MS, build

from tappet.iec.task import Task
from tappet.runtime.errors import PlcError
from tappet.runtime.plc import SoftPlc

FAST = "PROGRAM Fast\nVAR n : DINT; END_VAR\nn := n + 2;\nEND_PROGRAM\n"
SLOW = (
    "PROGRAM Slow\nVAR n : DINT; left : DINT := 3; END_VAR\n"
    "n := n + 1;\nn := n + 0 / (left + 1 - n);\nEND_PROGRAM\n"
)
TASKS = (
    Task("FastTask", "cyclic", MS, 1, programs=("Fast",)),
    Task("SlowTask", "cyclic", 40 * MS, 2, programs=("Slow",)),
)


@pytest.fixture
def plc() -> Iterator[SoftPlc]:
    plc = SoftPlc(None)
    plc.load(build(FAST + SLOW, TASKS))
    yield plc
    plc.close()


def value(plc: SoftPlc, path: str) -> object:
    ref = plc.symbols().resolve(path)
    return plc.symbols().decode(ref, plc.read([(ref.offset, ref.size)])[0])


def test_each_task_runs_once_per_order(plc: SoftPlc) -> None:
    for cycles in (1, 2, 3):
        plc.single_cycle()
        assert (value(plc, "Fast.n"), value(plc, "Slow.n")) == (2 * cycles, cycles)
        assert plc.state == "stop"
    assert [t.iec_cycles for t in plc.tasks()] == [3, 3]


def test_only_a_stopped_application(plc: SoftPlc) -> None:
    plc.start()
    with pytest.raises(PlcError, match="stopped application"):
        plc.single_cycle()


def test_values_of_a_run_are_gone_on_with(plc: SoftPlc) -> None:
    plc.start()
    while value(plc, "Slow.n") == 0:
        pass
    plc.stop()
    before = value(plc, "Fast.n")
    plc.single_cycle()
    assert value(plc, "Fast.n") == before + 2


def test_an_exception_in_it_is_one_of_the_application(plc: SoftPlc) -> None:
    for _ in range(4):
        plc.single_cycle()
    report = plc.exception()
    assert report is not None
    assert (report.task, report.pou) == ("SlowTask", "Slow")
    with pytest.raises(PlcError, match="state exception"):
        plc.single_cycle()


def test_without_a_task_that_starts_by_itself() -> None:
    plc = SoftPlc(None)
    event = Task("OnEvent", "event", 0, 1, event="Fast.go", programs=("Fast",))
    text = FAST.replace("n : DINT;", "n : DINT; go : BOOL;")
    plc.load(build(text, (event,)))
    try:
        with pytest.raises(PlcError, match="cyclic or freewheeling"):
            plc.single_cycle()
    finally:
        plc.close()
