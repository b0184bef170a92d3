"""Breakpoints outlive the process of a runtime, in its folder; files that are no such files do no harm."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from debugger_programs import add, at_line, halted, loaded
from hypothesis import given
from hypothesis import strategies as st
from msgspec.structs import replace

from tappet.runtime.debugger.kept import FILE, LARGEST, Kept, load
from tappet.runtime.debugger.shapes import BreakpointOrder, Hits, Settings
from tappet.runtime.logbook import Logbook
from tappet.runtime.plc import SoftPlc

TEXT = "PROGRAM PLC_PRG\nVAR\n    i : DINT;\nEND_VAR\ni := i + 1;\ni := i + 0;\nEND_PROGRAM\n"
ORDERS = [
    replace(at_line(5), condition="i > 3", hits=Hits("every", 4)),
    replace(at_line(6), log="i is {i}", enabled=False),
    BreakpointOrder("data", None, "PLC_PRG.i", task="Main"),
]


def test_they_come_back_disabled_after_a_restart(tmp_path: Path) -> None:
    plc = loaded(TEXT, plc=SoftPlc(tmp_path))
    for order in [*ORDERS, replace(at_line(5), kept=False)]:
        plc.debugger.add(order)
    plc.debugger.set_settings(Settings("safe", "halt"))
    gone = plc.debugger.add(at_line(6))
    plc.debugger.change(plc.debugger.add(at_line(6)).id, at_line(5))
    plc.debugger.remove(gone.id)
    plc.close()

    plc = SoftPlc(tmp_path)
    try:
        state = plc.debugger.state()
        expected = [*ORDERS, at_line(5)]
        assert [one.order for one in state.breakpoints] == [replace(o, enabled=False) for o in expected]
        assert state.settings == Settings("safe", "halt")
        loaded(TEXT, plc=plc)
        assert all(one.verified for one in plc.debugger.state().breakpoints)
        plc.start()
        assert not plc.debugger.state().active, "nothing is to halt, so the normal code runs"
        last = state.breakpoints[-1]
        plc.debugger.change(last.id, replace(last.order, enabled=True))
        assert halted(plc).halted[0].breakpoint_id == last.id
        assert add(plc, 6).id not in [one.id for one in state.breakpoints]
    finally:
        plc.close()


def test_all_are_enabled_and_disabled_at_once(tmp_path: Path) -> None:
    """As one does after a restart; hits go on counting, and it is kept as it is."""
    plc = loaded(TEXT, plc=SoftPlc(tmp_path))
    first = add(plc, 5)
    plc.debugger.add(replace(at_line(6), enabled=False))
    plc.start()
    halted(plc)
    state = plc.debugger.enable(False)
    assert [one.order.enabled for one in state.breakpoints] == [False, False]
    assert state.halted, "what is halted stays so"
    plc.debugger.control("continue")
    assert not plc.debugger.state().active
    state = plc.debugger.enable(True)
    assert [one.order.enabled for one in state.breakpoints] == [True, True]
    assert halted(plc).halted[0].breakpoint_id == first.id
    assert plc.debugger.state().breakpoints[0].hit_count == 2
    plc.close()
    plc = SoftPlc(tmp_path)
    try:
        assert [one.order.enabled for one in plc.debugger.state().breakpoints] == [False, False]
        state = plc.debugger.enable(True)
        assert [one.order.enabled for one in state.breakpoints] == [True, True]
        loaded(TEXT, plc=plc)
        plc.start()
        assert halted(plc).halted[0].breakpoint_id == state.breakpoints[0].id
    finally:
        plc.close()


def test_none_are_left_when_all_are_removed(tmp_path: Path) -> None:
    plc = SoftPlc(tmp_path)
    plc.debugger.add(ORDERS[0])
    plc.debugger.remove(None)
    plc.close()
    plc = SoftPlc(tmp_path)
    assert plc.debugger.state().breakpoints == []
    plc.close()


@pytest.mark.parametrize(
    "data",
    [
        b"",
        b"{",
        b"[]",
        b'{"version": 2}',
        b'{"version": 1, "later": 0}',
        b'{"breakpoints": [{"kind": "thread"}]}',
        b'{"breakpoints": [{"place": {"object_id": "x", "line": 0}}]}',
        b'{"breakpoints": [{"hits": {"mode": "equal", "count": -1}}]}',
        b'{"settings": {"outputs": "open"}}',
        json.dumps({"breakpoints": [{}] * 1001}).encode(),
        b"[" * 100_000,
        b"\xff\xfe\x00",
        b" " * (LARGEST + 1),
    ],
)
def test_a_damaged_file_is_logged_and_replaced(tmp_path: Path, data: bytes) -> None:
    (tmp_path / FILE).write_bytes(data)
    plc = SoftPlc(tmp_path)
    try:
        assert plc.debugger.state().breakpoints == []
        assert [e.severity for e in plc.log.since() if FILE in e.message] == ["warning"]
        plc.debugger.add(ORDERS[0])
        assert len(load(tmp_path, Logbook()).breakpoints) == 1
    finally:
        plc.close()


def test_what_cannot_be_written_is_logged(tmp_path: Path) -> None:
    (tmp_path / FILE / "in the way").mkdir(parents=True)
    plc = SoftPlc(tmp_path)
    try:
        assert plc.debugger.add(ORDERS[0]).order == ORDERS[0]
        messages = [e.message for e in plc.log.since() if FILE in e.message]
        assert len(messages) == 2, "it is neither read nor written"
    finally:
        plc.close()


@given(st.binary(max_size=200))
def test_no_file_ends_a_runtime(tmp_path_factory: pytest.TempPathFactory, data: bytes) -> None:
    folder = tmp_path_factory.mktemp("kept")
    (folder / FILE).write_bytes(data)
    assert load(folder, Logbook()) == Kept()
