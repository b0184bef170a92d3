"""Traces in the runtime: rings, conditions and triggers by trace.md, sections 3, 9 and 10."""

from __future__ import annotations

import math
import time

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from msgspec.structs import replace
from plc_programs import MS, build
from traced import column, samples, spec_of, status, trace_data, traced

from tappet.iec.task import Task
from tappet.project.trace import TraceData
from tappet.runtime.errors import NoTraceError
from tappet.runtime.local import LocalRuntime
from tappet.runtime.trace_compiler import TraceSettingsError, samples_behind_trigger

TEXT = """
TYPE Mode : (Off, Ready, Run := 5) INT; END_TYPE
PROGRAM PLC_PRG
VAR
    s : DINT := -1; twice : LINT; half : LREAL; odd : BOOL; xRec : BOOL; level : DINT := 20; stage : Mode;
    p : POINTER TO DINT; data : ARRAY [0..9] OF INT; w : WORD; single : REAL; wave : LREAL; never : BOOL;
END_VAR
s := s + 1;
twice := 2 * s; half := s / 2.0; odd := s MOD 2 = 1; xRec := s >= 10 AND s < 20 OR s >= 30;
IF s >= 7 THEN stage := Mode.Run; END_IF
IF s >= 5 THEN p := ADR(s); END_IF
data[s MOD 10] := DINT_TO_INT(s); w := DINT_TO_WORD(s); single := DINT_TO_REAL(s) / 3;
wave := ABS((s MOD 40) - 20);
END_PROGRAM
"""
RISING = {"variable": "PLC_PRG.s", "edge": "positive", "level": "50"}


def _running() -> LocalRuntime:
    """`s` counts the cycles of 10 ms of virtual time from 0."""
    return LocalRuntime(build(TEXT))


def test_a_ring_without_trigger_holds_the_last_samples() -> None:
    """trace EX-05, TRC-02, TRC-27."""
    with _running() as runtime:
        traced(runtime, "PLC_PRG.s", "PLC_PRG.twice", buffer=100)
        runtime.run(cycles=250)
        assert column(runtime) == list(range(150, 250))
        assert column(runtime, 1) == [2 * s for s in range(150, 250)]
        assert (status(runtime).state, status(runtime).written) == ("recording", 250)


@pytest.mark.parametrize(
    ("position", "before", "after"), [(25, 75, 25), (100, 0, 100), (0, 100, 0), (50, 50, 50)]
)
def test_position_of_the_trigger(position: int, before: int, after: int) -> None:
    """trace EX-01, and trace EX-03 at 50 %: the event itself counts to the samples before."""
    with _running() as runtime:
        traced(runtime, "PLC_PRG.s", buffer=100, trigger={**RISING, "level": "150", "position": position})
        runtime.run(cycles=400)
        found = column(runtime)
        assert len(found) == 100
        assert found == list(range(151 - before, 151 + after))
        assert status(runtime).state == "done"
        assert status(runtime).trigger_sample == 150


def test_analog_trigger() -> None:
    """trace EX-03: triggered when s goes from 49 to 50; recorded are 1 .. 100."""
    with _running() as runtime:
        traced(runtime, "PLC_PRG.s", buffer=100, trigger={**RISING, "position": 50})
        runtime.run(cycles=50)
        assert status(runtime).state == "waiting"
        runtime.run(cycles=11)
        assert (status(runtime).state, status(runtime).remaining) == ("triggered", 40)
        runtime.run(cycles=200)
        assert column(runtime) == list(range(1, 101))


@pytest.mark.parametrize(
    ("trigger", "event"),
    [
        ({"variable": "PLC_PRG.odd", "edge": "positive"}, 1),
        ({"variable": "PLC_PRG.odd", "edge": "negative"}, 2),
        ({"variable": "PLC_PRG.odd", "edge": "both"}, 1),
        ({"variable": "PLC_PRG.s", "edge": "positive", "level": "PLC_PRG.level"}, 20),
        ({"variable": "PLC_PRG.stage", "edge": "positive", "level": "Run"}, 7),
        ({"variable": "PLC_PRG.wave", "edge": "negative", "level": "13.5"}, 7),
        ({"variable": "PLC_PRG.wave", "edge": "both", "level": "1.5"}, 19),
        ({"variable": "PLC_PRG.s * 2 > 30 AND PLC_PRG.odd", "edge": "positive"}, 17),
        ({"variable": "PLC_PRG.p^", "edge": "positive", "level": "9"}, 9),
        ({"variable": "PLC_PRG.never", "edge": "both"}, None),
        ({"variable": "PLC_PRG.s", "edge": "none", "level": "3"}, None),
    ],
)
def test_edges(trigger: dict[str, str], event: int | None) -> None:
    """TRC-20 .. TRC-22: BOOL, number, enumeration, expression, pointer; literal, variable and enumerator."""
    with _running() as runtime:
        traced(runtime, "PLC_PRG.s", buffer=10, trigger={**trigger, "position": 0})
        runtime.run(cycles=60)
        assert status(runtime).trigger_sample == event
        assert column(runtime)[-1] == (59 if event is None else event)


def test_recording_condition_leaves_a_gap() -> None:
    """trace EX-04, TRC-26: nothing is sampled while it is FALSE; cycle numbers and times show the gap."""
    with _running() as runtime:
        traced(runtime, "PLC_PRG.s", buffer=1000, condition="PLC_PRG.xRec")
        runtime.run(cycles=40)
        assert column(runtime) == [*range(10, 20), *range(30, 40)]
        found = samples(runtime)
        assert np.diff(found["cycle"]).tolist() == [1] * 9 + [11] + [1] * 9
        assert np.diff(found["time"]).tolist() == [10 * MS] * 9 + [110 * MS] + [10 * MS] * 9


def test_a_condition_may_be_a_number_and_one_without_value_is_false() -> None:
    with _running() as runtime:
        traced(runtime, "PLC_PRG.s", condition="PLC_PRG.s / 5")
        runtime.plc.download_trace(
            spec_of(runtime, trace_data("PLC_PRG.s", condition="PLC_PRG.p^ > 0"), "Other"), True
        )
        runtime.run(cycles=8)
        assert column(runtime) == [5, 6, 7]
        assert column(runtime, name="Other") == [5, 6, 7]


def test_every_nth_cycle_and_the_span_of_a_buffer() -> None:
    """TRC-25, trace EX-02: buffer x n x interval."""
    task = Task("Fast", interval_ns=4 * MS, programs=("PLC_PRG",))
    with LocalRuntime(build(TEXT, (task,))) as runtime:
        traced(runtime, "PLC_PRG.s", buffer=500, every=2)
        runtime.run(cycles=2000)
        found = samples(runtime)
        assert len(found) == 500
        assert set(np.diff(found["0"]).tolist()) == {2}
        assert found["time"][-1] - found["time"][0] + 2 * 4 * MS == 4_000 * MS


def test_values_of_one_sample_are_of_one_cycle() -> None:
    """Section 9, in real time."""
    task = Task("Main", interval_ns=1 * MS, programs=("PLC_PRG",))
    with LocalRuntime(build(TEXT, (task,)), virtual=False) as runtime:
        traced(runtime, "PLC_PRG.s", "PLC_PRG.twice", "PLC_PRG.half", "PLC_PRG.s + PLC_PRG.twice", buffer=100)
        while status(runtime).written < 120:
            runtime.run(cycles=10)
        found = samples(runtime)
        assert (found["1"] == 2 * found["0"]).all()
        assert (found["2"] == found["0"] / 2).all()
        assert (found["3"] == 3 * found["0"]).all()
        assert (np.diff(found["time"]) > 0).all()
        assert (np.diff(found["time"]) % MS == 0).all()  # the grid of the task, without jitter


def test_all_that_a_variable_may_be() -> None:
    """TRC-40: bits, elements with computed index, pointer content, expressions, REAL, enumerations."""
    texts = [
        "PLC_PRG.w.0", "PLC_PRG.data[PLC_PRG.s MOD 10]", "PLC_PRG.p^", "PLC_PRG.single", "PLC_PRG.stage",
        "PLC_PRG.odd", "PLC_PRG.s > 3", "PLC_PRG.half", "plc_prg.DATA[ 3 ]",
    ]  # fmt: skip
    with _running() as runtime:
        traced(runtime, *texts, buffer=100)
        runtime.run(cycles=12)
        bit, element, target, single, mode, odd, above, half, third = (column(runtime, n) for n in range(9))
        assert [v & 1 for v in bit] == [s % 2 for s in range(12)]
        assert element == list(range(12))
        assert all(math.isnan(v) for v in target[:5])
        assert target[5:] == list(range(5, 12))
        assert single == [float(np.float32(s) / np.float32(3)) for s in range(12)]
        assert mode == [0] * 7 + [5] * 5
        assert [v & 1 for v in odd] == [s % 2 for s in range(12)]
        assert above == [float(s > 3) for s in range(12)]
        assert half == [s / 2 for s in range(12)]
        assert third == [0] * 3 + [3] * 9


def test_stop_start_and_reset_of_the_trigger() -> None:
    """TRC-74, TRC-82."""
    with _running() as runtime:
        plc = runtime.plc
        traced(runtime, "PLC_PRG.s", buffer=20)
        runtime.run(cycles=10)
        plc.command_trace("trace", "stop")
        runtime.run(cycles=10)
        assert (status(runtime).state, column(runtime)) == ("stopped", list(range(10)))
        plc.command_trace("Trace", "start")
        runtime.run(cycles=5)
        assert column(runtime) == [*range(10), *range(20, 25)]
        trigger = {"variable": "PLC_PRG.odd", "edge": "positive", "position": 50}
        traced(runtime, "PLC_PRG.s", buffer=4, trigger=trigger)
        runtime.run(cycles=10)
        assert (status(runtime).state, column(runtime)) == ("done", [26, 27, 28, 29])
        plc.command_trace("Trace", "rearm")
        runtime.run(cycles=1)
        assert (status(runtime).state, status(runtime).trigger_sample) == ("waiting", None)
        runtime.run(cycles=9)
        assert status(runtime).state == "done"
        assert column(runtime) == [36, 37, 38, 39]


def test_a_trace_is_started_by_hand_after_a_download_without_start() -> None:
    """TRC-70."""
    with _running() as runtime:
        runtime.plc.download_trace(spec_of(runtime, trace_data("PLC_PRG.s")), False)
        runtime.run(cycles=5)
        assert (status(runtime).state, status(runtime).written) == ("stopped", 0)


def test_nothing_is_sampled_while_the_application_is_stopped() -> None:
    """TRC-26: it begins when the application runs; cycles go on without programs."""
    task = Task("Main", interval_ns=1 * MS, programs=("PLC_PRG",))
    with LocalRuntime(build(TEXT, (task,)), virtual=False) as runtime:
        traced(runtime, "PLC_PRG.s")
        runtime.run(cycles=3)
        runtime.stop()
        stopped, cycles = status(runtime).written, runtime.statistics()[0].cycles
        end = time.monotonic() + 20
        while runtime.statistics()[0].cycles < cycles + 5:
            assert time.monotonic() < end
        assert status(runtime).written == stopped
        runtime.start()
        runtime.run(cycles=2)
        found = samples(runtime)
        assert found["0"].tolist() == list(range(found["0"][0], found["0"][0] + len(found)))
        assert found["cycle"][stopped] - found["cycle"][stopped - 1] > 5


def test_time_goes_on_over_a_reset() -> None:
    with _running() as runtime:
        traced(runtime, "PLC_PRG.s")
        runtime.run(cycles=3)
        runtime.reset("cold")
        runtime.start()
        runtime.run(cycles=2)
        assert column(runtime) == [0, 1, 2, 0, 1]
        assert np.diff(samples(runtime)["time"]).min() > 0


def test_several_traces_and_records_at_once() -> None:
    """TRC-03: different triggers need different traces."""
    two = {"name": "B", "channels": [{"variable": "PLC_PRG.half"}], "every": 3}
    first = trace_data("PLC_PRG.s").records[0].model_dump()
    data = {"records": [first, two]}
    with _running() as runtime:
        both = spec_of(runtime, TraceData.model_validate(data), "Both")
        runtime.plc.download_trace(both, True)
        traced(runtime, "PLC_PRG.twice", buffer=5)
        runtime.run(cycles=10)
        assert [t.name for t in runtime.plc.traces()] == ["Both", "Trace"]
        assert samples(runtime, "Both", 1)["0"].tolist() == [0, 1.5, 3, 4.5]
        assert column(runtime) == [10, 12, 14, 16, 18]
        runtime.plc.remove_trace("both")
        runtime.run(cycles=1)
        assert [t.name for t in runtime.plc.traces()] == ["Trace"]


def test_more_than_twenty_variables_lose_no_sample() -> None:
    """ONL-01: 21 variables with 500 samples each, at the edge of a BOOL."""
    names = [f"PLC_PRG.s + {number}" for number in range(21)]
    with _running() as runtime:
        trigger = {"variable": "PLC_PRG.xRec", "edge": "positive", "position": 100}
        traced(runtime, *names, buffer=500, trigger=trigger)
        runtime.run(cycles=600)
        assert status(runtime).state == "done"
        for number in range(21):
            assert column(runtime, number) == [cycle + number for cycle in range(11, 511)]


def test_a_changed_application_ends_the_trace() -> None:
    """TRC-70, trace EX-07: online change and download; a reset does not."""
    first = build(TEXT)
    with LocalRuntime(first) as runtime:
        for changed in (
            TEXT.replace("2 * s", "3 * s"),
            TEXT.replace("never : BOOL", "never : BOOL; more : LINT"),
        ):
            traced(runtime, "PLC_PRG.s")
            runtime.run(cycles=2)
            runtime.reset("warm")
            assert runtime.plc.traces()
            runtime.start()
            package = build(changed, previous=runtime.package)
            runtime.plc.download(package.to_bytes(), "online_change")
            assert runtime.plc.traces() == []
            runtime.run(cycles=2)
        traced(runtime, "PLC_PRG.s")
        runtime.plc.load(first)
        assert runtime.plc.traces() == []


def test_what_is_wrong_is_told_by_record_channel_and_field() -> None:
    data = trace_data(
        "PLC_PRG.s", "PLC_PRG.nix", condition="PLC_PRG.s +", task="Slow", trigger={**RISING, "level": "Up"}
    )
    with _running() as runtime:
        with pytest.raises(TraceSettingsError) as caught:
            spec_of(runtime, data)
        places = [(p.record, p.channel, p.field) for p in caught.value.problems]
        assert places == [
            (0, None, "task"), (0, None, "condition"), (0, 1, "variable"), (0, None, "trigger.level")
        ]  # fmt: skip
        other = trace_data("PLC_PRG.s", trigger={"variable": "PLC_PRG.nix", "edge": "both"})
        with pytest.raises(TraceSettingsError) as caught:
            spec_of(runtime, other)
        assert [(p.field, p.channel) for p in caught.value.problems] == [("trigger.variable", None)]
        with pytest.raises(NoTraceError, match="no trace 'Trace'"):
            runtime.plc.take_trace("Trace", 0, 0, 1)
        traced(runtime, "PLC_PRG.s")
        with pytest.raises(NoTraceError, match="no record number 1"):
            runtime.plc.take_trace("Trace", 1, 0, 1)


def test_a_ring_has_a_largest_size() -> None:
    many = [f"PLC_PRG.twice + {n}" for n in range(100)]
    data = trace_data(*many, buffer=1_000_000).model_copy(update={"points": 1_000_000})
    with _running() as runtime:
        spec = spec_of(runtime, data)
        with pytest.raises(ValueError, match="at most 256"):
            runtime.plc.download_trace(spec, True)


@given(st.integers(1, 1000), st.integers(0, 100))
def test_samples_behind_the_trigger_are_rounded(samples: int, position: int) -> None:
    assert abs(samples_behind_trigger(samples, position) - samples * position / 100) <= 0.5


def _model(
    values: list[int], level: int, edge: str, samples: int, after: int, every: int
) -> tuple[int | None, list[int]]:
    """The record by section 9: number of the triggering sample, and what the ring shows."""
    ring: list[int] = []
    trigger: int | None = None
    remaining = 0
    for number, value in enumerate(values[::every]):
        before = ring[-1] if ring else None
        ring.append(value)
        if trigger is not None:
            remaining -= 1
        elif before is not None and (
            (edge in ("positive", "both") and before < level <= value)
            or (edge in ("negative", "both") and before > level >= value)
        ):
            trigger, remaining = number, after
        if trigger is not None and remaining == 0:
            break
    return trigger, ring[-samples:]


@settings(max_examples=40, deadline=None)
@given(st.data())
def test_records_are_those_of_a_plain_model(data: st.DataObject) -> None:
    samples_wanted = data.draw(st.integers(1, 60))
    every = data.draw(st.integers(1, 4))
    position = data.draw(st.integers(0, 100))
    edge = data.draw(st.sampled_from(["positive", "negative", "both"]))
    level = data.draw(st.integers(-1, 21))
    cycles = data.draw(st.integers(1, 150))
    trigger = {"variable": "PLC_PRG.wave", "edge": edge, "level": str(level), "position": position}
    with _running() as runtime:
        traced(runtime, "PLC_PRG.wave", buffer=samples_wanted, every=every, trigger=trigger)
        runtime.run(cycles=cycles)
        values = [abs(s % 40 - 20) for s in range(cycles)]
        after = samples_behind_trigger(samples_wanted, position)
        event, ring = _model(values, level, edge, samples_wanted, after, every)
        assert column(runtime) == ring
        assert status(runtime).trigger_sample == event


def test_a_reader_that_is_late_learns_what_is_overwritten() -> None:
    with _running() as runtime:
        data = trace_data("PLC_PRG.s", buffer=10)
        spec = spec_of(runtime, data)
        short = replace(spec, records=[replace(spec.records[0], reserve=0)])
        runtime.plc.download_trace(short, True)
        runtime.run(cycles=1000)
        frames = runtime.plc.take_trace("Trace", 0, 0, 1000)
        assert frames.first == 1000 - frames.count > 900
        assert frames.count >= 10


PROPERTY = """
FUNCTION_BLOCK FB
VAR n : INT; END_VAR
{attribute 'monitoring' := 'call'}
PROPERTY Twice : INT
GET
Twice := 2 * n;
END_GET
END_PROPERTY
n := n + 1;
END_FUNCTION_BLOCK
PROGRAM PLC_PRG
VAR fb : FB; END_VAR
fb();
END_PROGRAM
"""


def test_properties_are_sampled_and_trigger() -> None:
    """TRC-20, TRC-40: Get is called in the cycle, also for a property that only the trigger reads."""
    with LocalRuntime(build(PROPERTY)) as runtime:
        traced(runtime, "PLC_PRG.fb.Twice", "PLC_PRG.fb.n", buffer=10)
        runtime.run(cycles=10)
        assert column(runtime)[1:] == [2 * n for n in column(runtime, 1)][1:]
        runtime.plc.remove_trace("Trace")
        trigger = {"variable": "PLC_PRG.fb.Twice", "edge": "positive", "level": "50", "position": 0}
        traced(runtime, "PLC_PRG.fb.n", buffer=10, trigger=trigger)
        runtime.run(cycles=30)
        assert status(runtime).state == "done"
        assert column(runtime)[-1] == 25


@pytest.mark.parametrize("dead", [1, 3, 7])
def test_dead_time_is_the_horizontal_distance_of_two_curves(dead: int) -> None:
    """trace EX-08: set and actual position in the task that moves the axis; distance over cycle time."""
    text = f"""
    PROGRAM PLC_PRG
    VAR
        fSetPosition, fActPosition : LREAL; n : INT; aSent : ARRAY [0..{dead}] OF LREAL;
    END_VAR
    n := n + 1;
    fSetPosition := SEL(n > 20, 0.0, MIN(5.0, (n - 20) * 0.7));
    aSent[n MOD {dead + 1}] := fSetPosition;
    fActPosition := aSent[(n + 1) MOD {dead + 1}];
    END_PROGRAM
    """
    with LocalRuntime(build(text)) as runtime:
        traced(runtime, "PLC_PRG.fSetPosition", "PLC_PRG.fActPosition", buffer=60)
        runtime.run(cycles=60)
        found = samples(runtime)
        first, behind = (found["time"][np.argmax(found[name] >= 2.0)] for name in ("0", "1"))
        assert (behind - first) / status(runtime).interval_ns == dead


@pytest.mark.parametrize(("edge", "first"), [("positive", 301), ("negative", 601)])
def test_twenty_variables_with_500_values_around_an_edge_of_a_bool(edge: str, first: int) -> None:
    """LST-80: the least that a sampling trace must hold."""
    names = ", ".join(f"v{i}" for i in range(20))
    filled = " ".join(f"v{i} := n * 100 + {i};" for i in range(20))
    text = f"PROGRAM PLC_PRG\nVAR n : DINT; x : BOOL; {names} : DINT; END_VAR\nn := n + 1; {filled}\n"
    with LocalRuntime(build(f"{text}x := n > 300 AND n <= 600;\nEND_PROGRAM")) as runtime:
        variables = [f"PLC_PRG.v{i}" for i in range(20)]
        trigger = {"variable": "PLC_PRG.x", "edge": edge, "position": 50}
        traced(runtime, *variables, buffer=500, trigger=trigger)
        runtime.run(cycles=1200)
        assert status(runtime).state == "done"
        wanted = range(first - 249, first + 251)
        for i in range(20):
            assert column(runtime, i) == [n * 100 + i for n in wanted]
