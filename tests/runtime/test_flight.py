"""The flight recorder: every past cycle bit by bit, bounds, freezing, online change, large images."""

import itertools
from random import Random

import pytest
from plc_programs import MS, build
from test_service import FAST, TOKEN, serving, until
from test_service import TEXT as SERVED

from tappet.iec.task import Task
from tappet.runtime.client import RuntimeClient, RuntimeRefused
from tappet.runtime.flight import FlightSettings
from tappet.runtime.flight_deltas import ENTRY_SIZE, FlightError
from tappet.runtime.flight_recording import read_recording
from tappet.runtime.local import ApplicationException, LocalRuntime
from tappet.runtime.operations.flight import (
    FreezeFlight,
    GetFlightStatus,
    ListFlightCycles,
    ReadFlight,
    SaveFlight,
)
from tappet.runtime.operations.life_cycle import Start
from tappet.runtime.operations.values import Read
from tappet.runtime.posix import write_memory

TEXT = """
FUNCTION_BLOCK FB_Noise
VAR seed : UDINT := 1; values : ARRAY [0..199] OF REAL; k : INT; END_VAR
seed := seed * 1664525 + 1013904223;
k := UDINT_TO_INT(seed MOD 200);
values[k] := UDINT_TO_REAL(seed);
END_FUNCTION_BLOCK

PROGRAM PLC_PRG
VAR
    n : LINT; slow : INT; text : STRING(80); flag : BOOL; out AT %QW2 : WORD;
    noise : ARRAY [0..2] OF FB_Noise; i : INT; quiet : ARRAY [0..999] OF LREAL; zero : DINT; fail : BOOL;
END_VAR
n := n + 1;
IF n MOD 7 = 0 THEN slow := slow + 1; noise[1](); END_IF
IF n MOD 50 = 0 THEN
    FOR i := 0 TO 999 DO quiet[i] := quiet[i] + 1.5; END_FOR
    text := 'fifty more';
END_IF
flag := NOT flag;
out := LINT_TO_WORD(n * 3);
FOR i := 0 TO 2 DO noise[i](); END_FOR
IF fail THEN zero := 5 / zero; END_IF
END_PROGRAM
"""
WRITTEN = """
PROGRAM PLC_PRG
VAR n : DINT; all : ARRAY [0..{0}] OF LINT; i : DINT; END_VAR
n := n + 1;
FOR i := 0 TO {0} DO all[i] := all[i] + i + n; END_FOR
END_PROGRAM
"""


def live_image(runtime: LocalRuntime) -> bytes:
    application = runtime.plc.application
    assert application is not None
    return application.image.read(0, application.image.size)


def past_image(runtime: LocalRuntime, cycle: int) -> bytes:
    application = runtime.plc.application
    assert application is not None
    return runtime.plc.flight_read(cycle, [(0, application.image.size)])[0]


def run_and_keep(runtime: LocalRuntime, cycles: int) -> dict[int, bytes]:
    """The reference: the whole image, read after each single cycle."""
    images = {}
    application = runtime.plc.application
    assert application is not None
    assert application.ownership.bus is not None
    task = application.contexts.tasks[application.ownership.bus]
    for _ in range(cycles):
        runtime.run(cycles=1)
        images[task["cycle"]] = live_image(runtime)
    return images


def test_every_past_cycle_equals_what_was_read_then() -> None:
    with LocalRuntime(build(TEXT)) as runtime:
        images = run_and_keep(runtime, 400)
        history = runtime.flight_history()
        assert [cycle for cycle, _ in history] == list(images)
        stamps = [stamp for _, stamp in history]
        assert {b - a for a, b in itertools.pairwise(stamps)} == {10 * MS}
        for order in (list(images), list(reversed(images))):
            for cycle in order:
                assert past_image(runtime, cycle) == images[cycle], cycle
        symbols = runtime.package.symbols
        for path in ("PLC_PRG.n", "PLC_PRG.slow", "PLC_PRG.text", "PLC_PRG.out", "PLC_PRG.noise[1].values"):
            ref = symbols.resolve(path)
            for cycle in (1, 49, 50, 51, 399):
                then = images[cycle][ref.offset : ref.offset + ref.size]
                assert runtime.flight_read(cycle, path) == symbols.decode(ref, then)
        assert runtime.flight_read(350, "PLC_PRG.n") == 350


def test_writes_and_forces_are_in_the_past_too() -> None:
    with LocalRuntime(build(TEXT)) as runtime:
        runtime.run(cycles=3)
        runtime.write("PLC_PRG.slow", 500)
        runtime.run(cycles=2)
        runtime.force("PLC_PRG.flag", True)
        runtime.run(cycles=3)
        assert [runtime.flight_read(c, "PLC_PRG.slow") for c in (3, 4, 8)] == [0, 500, 501]
        assert [runtime.flight_read(c, "PLC_PRG.flag") for c in range(4, 9)] == [
            False,
            True,
            True,
            True,
            True,
        ]


@pytest.mark.parametrize("divider", [2, 5])
def test_every_nth_cycle(divider: int) -> None:
    with LocalRuntime(build(TEXT), flight=FlightSettings(divider=divider)) as runtime:
        images = run_and_keep(runtime, 60)
        kept = [cycle for cycle, _ in runtime.flight_history()]
        assert kept == list(range(1, 61, divider))
        assert runtime.flight_status().period == divider
        for cycle in kept:
            assert past_image(runtime, cycle) == images[cycle]
        with pytest.raises(FlightError, match=r"cycle 2 is not kept; .* 1 to .* next to it 1 and"):
            runtime.flight_read(2, "PLC_PRG.n")


@pytest.mark.parametrize("words", [40, 3000])
def test_the_memory_bound_holds_and_what_is_left_is_right(words: int) -> None:
    """Many times around the ring, with entries of changing size."""
    settings = FlightSettings(memory=256 << 10)
    with LocalRuntime(build(WRITTEN.format(words)), flight=settings) as runtime:
        for _ in range(6):
            runtime.run(cycles=1500)
            status = runtime.flight_status()
            assert 0 < status.used <= settings.memory
        images = run_and_keep(runtime, 4)
        status = runtime.flight_status()
        assert status.last_cycle == max(images)
        assert 4 <= status.count < 9000
        for cycle, image in images.items():
            assert past_image(runtime, cycle) == image
        oldest = runtime.flight_history()[0][0]
        assert runtime.flight_read(oldest, "PLC_PRG.n") == oldest


@pytest.mark.parametrize(("seed", "words"), [(1, 1), (2, 13), (3, 901), (4, 2500)])
def test_bytes_changed_anywhere_come_back(seed: int, words: int) -> None:
    """Changes at any place and of any length, the first and the last byte included, in a small ring."""
    random = Random(seed)
    text = f"PROGRAM PLC_PRG VAR big : ARRAY [0..{words}] OF LINT; n : DINT; END_VAR n := n + 1; END_PROGRAM"
    with LocalRuntime(build(text), flight=FlightSettings(memory=160 << 10)) as runtime:
        application = runtime.plc.application
        assert application is not None
        size = application.image.size
        images: dict[int, bytes] = {}
        assert runtime.flight_status().parts == 1
        for _ in range(400):
            for _ in range(random.choice((0, 1, 1, 5))):
                length = random.choice((1, 3, 64, 65, 700, size))
                at = random.choice((0, size - min(length, size), random.randrange(size)))
                application.image.write(at, random.randbytes(min(length, size - at)))
            images |= run_and_keep(runtime, 1)
        kept = [cycle for cycle, _ in runtime.flight_history()]
        assert len(kept) >= 4
        assert kept == list(images)[-len(kept) :]
        random.shuffle(kept)
        for cycle in kept:
            assert past_image(runtime, cycle) == images[cycle], cycle


def test_nothing_is_older_than_the_time_limit() -> None:
    with LocalRuntime(build(TEXT), flight=FlightSettings(seconds=0.5)) as runtime:
        runtime.run(cycles=1000)
        history = runtime.flight_history()
        assert [cycle for cycle, _ in history] == list(range(950, 1001))
        assert runtime.flight_read(950, "PLC_PRG.n") == 950


def test_a_fault_keeps_the_cycles_before_it() -> None:
    with LocalRuntime(build(TEXT)) as runtime:
        images = run_and_keep(runtime, 120)
        runtime.write("PLC_PRG.fail", True)
        with pytest.raises(ApplicationException):
            runtime.run(cycles=50)
        for _ in range(3):
            with pytest.raises(ApplicationException):
                runtime.run(cycles=1)
        status = runtime.flight_status()
        assert (status.frozen, status.frozen_by, status.last_cycle) == (True, "exception", 121)
        assert past_image(runtime, 121) == live_image(runtime), "the cycle of the fault itself"
        for cycle, image in images.items():
            assert past_image(runtime, cycle) == image
        assert runtime.flight_read(120, "PLC_PRG.fail") is False
        runtime.flight_freeze(False)
        assert runtime.flight_status().frozen, "only a reset ends an exception"
        runtime.reset("cold")
        assert past_image(runtime, 100) == images[100], "readable until the next start"
        runtime.start()
        again = run_and_keep(runtime, 5)
        assert [c for c, _ in runtime.flight_history()] == list(again)
        assert runtime.flight_read(max(again), "PLC_PRG.n") == 5


def test_a_watchdog_in_real_time_freezes() -> None:
    text = """PROGRAM PLC_PRG VAR n : LINT; END_VAR
    n := n + 1;
    WHILE n > 100 DO ; END_WHILE
    END_PROGRAM"""
    task = Task("Main", interval_ns=1 * MS, programs=("PLC_PRG",))
    with LocalRuntime(build(text, (task,)), virtual=False, cycle_limit_s=2.0) as runtime:
        with pytest.raises(ApplicationException):
            runtime.run(time_ns=60_000 * MS)
        values = [runtime.flight_read(cycle, "PLC_PRG.n") for cycle, _ in runtime.flight_history()]
        assert values == list(range(1, 102))
        assert runtime.flight_status().frozen_by == "exception"


def test_freeze_on_request_and_going_on() -> None:
    with LocalRuntime(build(TEXT)) as runtime:
        images = run_and_keep(runtime, 20)
        assert runtime.flight_freeze(True).frozen_by == "request"
        runtime.run(cycles=2000)
        assert [c for c, _ in runtime.flight_history()] == list(images)
        assert past_image(runtime, 7) == images[7]
        assert not runtime.flight_freeze(False).frozen
        images |= run_and_keep(runtime, 3)
        assert runtime.flight_status().last_cycle == 2023
        for cycle in (2021, 2022, 2023):
            assert past_image(runtime, cycle) == images[cycle]
        runtime.flight_freeze(True)
        runtime.stop()
        runtime.start()
        assert not runtime.flight_status().frozen


def test_stopped_cycles_are_not_recorded() -> None:
    task = Task("Main", interval_ns=1 * MS, programs=("PLC_PRG",))
    with LocalRuntime(build(TEXT, (task,)), virtual=False) as runtime:
        runtime.run(cycles=20)
        runtime.stop()
        before = runtime.flight_history()
        application = runtime.plc.application
        assert application is not None
        cycle = application.contexts.tasks[0]["cycle"]
        while application.contexts.tasks[0]["cycle"] < cycle + 5:
            pass
        assert runtime.flight_history() == before
        runtime.start()
        runtime.run(cycles=20)
        runtime.flight_freeze(True)  # what is read below must not be overwritten meanwhile
        after = runtime.flight_history()
        assert after[: len(before)] == before
        values = [runtime.flight_read(c, "PLC_PRG.n") for c, _ in after]
        assert values == list(range(1, len(values) + 1))


def test_reading_beside_a_fast_task() -> None:
    """Every value of an entry is of its cycle, also while the ring turns around under the reader."""
    text = WRITTEN.format(500)
    task = Task("Main", interval_ns=MS // 2, programs=("PLC_PRG",))
    with LocalRuntime(
        build(text, (task,)), virtual=False, flight=FlightSettings(memory=512 << 10)
    ) as runtime:
        runtime.run(cycles=100)
        whole = 0
        for _ in range(60):
            cycle, _ = runtime.flight_history()[-20]
            try:
                image = past_image(runtime, cycle)
            except FlightError:
                continue  # a busy machine: dropped meanwhile
            symbols = runtime.package.symbols
            n = int.from_bytes(image[(o := symbols.resolve("PLC_PRG.n").offset) : o + 4], "little")
            total = n * (n + 1) // 2
            at = symbols.resolve("PLC_PRG.all").offset
            found = [int.from_bytes(image[at + 8 * i : at + 8 * i + 8], "little") for i in range(501)]
            assert found == [total + n * i for i in range(501)]
            whole += 1
        assert whole


def test_a_large_image_is_recorded_in_parts_and_says_so() -> None:
    text = """PROGRAM PLC_PRG
    VAR n : LINT; big : ARRAY [0..499_999] OF LINT; END_VAR
    n := n + 1;
    big[(n * 7919) MOD 500_000] := n;
    big[499_999] := n;
    END_PROGRAM"""
    with LocalRuntime(build(text)) as runtime:
        status = runtime.flight_status()
        assert status.parts == 4
        assert any("one of 4 parts" in e.message for e in runtime.plc.log.since())
        images = run_and_keep(runtime, 24)
        first = images[min(images)]
        assert len(first) > 4_000_000
        application = runtime.plc.application
        assert application is not None
        assert application.flight is not None
        size = application.flight.record["partSize"]
        assert size <= 1 << 20
        assert 3 * size < len(first) <= 4 * size
        for cycle in (8, 12, 24):
            past = past_image(runtime, cycle)
            for part in range(4):
                seen = cycle - (cycle - 1 - part) % 4  # part 0 in cycles 1, 5, ...; part 1 in 2, 6, ...
                place = slice(part * size, (part + 1) * size)
                assert past[place] == images[seen][place], (cycle, part)


def test_an_image_of_one_part_has_all_values_of_the_cycle() -> None:
    with LocalRuntime(build(WRITTEN.format(120_000))) as runtime:
        assert runtime.flight_status().parts == 1
        images = run_and_keep(runtime, 20)
        kept = [c for c, _ in runtime.flight_history()]
        assert kept[-1] == 20
        assert len(kept) >= 10
        for cycle in (kept[0], kept[len(kept) // 2], kept[-1]):
            assert past_image(runtime, cycle) == images[cycle]


ONE = "PROGRAM PLC_PRG VAR n : DINT; END_VAR n := n + 1; END_PROGRAM"


def change(runtime: LocalRuntime, text: str) -> None:
    runtime.plc.download(build(text, previous=runtime.package).to_bytes(), "online_change")


def test_online_change_of_code_keeps_the_past() -> None:
    with LocalRuntime(build(ONE)) as runtime:
        runtime.run(cycles=5)
        change(runtime, ONE.replace("+ 1", "+ 100"))
        runtime.run(cycles=2)
        assert [runtime.flight_read(c, "PLC_PRG.n") for c, _ in runtime.flight_history()] == [
            1, 2, 3, 4, 5, 105, 205,
        ]  # fmt: skip


def test_online_change_of_data_drops_the_past() -> None:
    with LocalRuntime(build(ONE)) as runtime:
        runtime.run(cycles=5)
        runtime.flight_freeze(True)
        change(runtime, ONE.replace(" VAR n", " VAR more : ARRAY [0..9999] OF LREAL; n"))
        assert runtime.flight_history() == []
        assert not runtime.flight_status().frozen
        images = run_and_keep(runtime, 5)
        for cycle, image in images.items():
            assert past_image(runtime, cycle) == image
        assert runtime.flight_read(10, "PLC_PRG.n") == 10
        with pytest.raises(FlightError, match="cycle 3 is not kept"):
            runtime.flight_read(3, "PLC_PRG.n")


def test_damaged_memory_of_the_recorder_is_named() -> None:
    with LocalRuntime(build(TEXT)) as runtime:
        runtime.run(cycles=10)
        application = runtime.plc.application
        assert application is not None
        assert application.flight is not None
        record = application.flight.record
        write_memory(record["pRing"] + 20, b"\x5a")  # in the first entry, which leads back to the start
        assert runtime.flight_read(2, "PLC_PRG.n") == 2
        size = record["pEntries"] + 9 * ENTRY_SIZE + 8  # of the last entry
        for wrong in (1 << 40, -8, 24):
            write_memory(size, wrong.to_bytes(8, "little", signed=True))
            assert runtime.flight_read(10, "PLC_PRG.n") == 10
            with pytest.raises(FlightError, match="entry of cycle 10 is damaged"):
                runtime.flight_read(9, "PLC_PRG.n")


def test_the_bus_cycle_task_records() -> None:
    tasks = (
        Task("Slow", interval_ns=50 * MS, programs=("Other",)),
        Task("Fast", interval_ns=10 * MS, programs=("PLC_PRG",)),
    )
    text = ONE + " PROGRAM Other VAR m : DINT; END_VAR m := m + 1; END_PROGRAM"
    with LocalRuntime(build(text, tasks)) as runtime:
        images = run_and_keep(runtime, 30)
        assert [c for c, _ in runtime.flight_history()] == list(range(1, 31))
        assert [runtime.flight_read(c, "PLC_PRG.n") for c in range(1, 31)] == list(range(1, 31))
        seen = [runtime.flight_read(c, "Other.m") for c in range(1, 31)]
        assert seen == sorted(seen)
        assert seen[-1] == 6
        assert images


def test_a_fault_of_another_task_freezes() -> None:
    tasks = (
        Task("Slow", interval_ns=50 * MS, programs=("Other",)),
        Task("Fast", interval_ns=10 * MS, programs=("PLC_PRG",)),
    )
    text = (
        ONE
        + """
    PROGRAM Other VAR m, zero : DINT; END_VAR
    m := m + 1;
    IF m = 4 THEN m := 1 / zero; END_IF
    END_PROGRAM"""
    )
    with LocalRuntime(build(text, tasks)) as runtime:
        with pytest.raises(ApplicationException):
            runtime.run(cycles=100)
        status = runtime.flight_status()
        assert status.frozen_by == "exception"
        assert status.last_cycle is not None
        assert status.last_cycle in (15, 16)
        assert [runtime.flight_read(c, "PLC_PRG.n") for c in (1, 10, status.last_cycle)] == [
            1, 10, status.last_cycle,
        ]  # fmt: skip
        assert runtime.flight_read(status.last_cycle, "Other.m") == 3


def test_switched_off_and_without_application() -> None:
    with LocalRuntime(build(ONE), flight=FlightSettings(memory=0)) as runtime:
        runtime.run(cycles=5)
        with pytest.raises(RuntimeError, match="the flight recorder is off"):
            runtime.flight_status()


@pytest.mark.parametrize(
    "wrong", [{"memory": 1000}, {"memory": -1}, {"seconds": 0}, {"divider": 0}, {"scan_limit": 1}]
)
def test_impossible_settings_are_refused(wrong: dict[str, int]) -> None:
    with pytest.raises(ValueError, match=r"at least|more than"):
        FlightSettings(**wrong)


async def test_over_the_wire() -> None:
    async with serving() as (url, _), await RuntimeClient.connect(url, TOKEN) as client:
        with pytest.raises(RuntimeRefused, match="download one first"):
            await client.call(GetFlightStatus())
        await client.download(build(SERVED, FAST).to_bytes())
        await client.call(Start())

        async def enough() -> bool:
            return (await client.call(GetFlightStatus())).count > 20

        await until(enough)
        assert (await client.call(FreezeFlight(True))).frozen
        history = await client.call(ListFlightCycles())
        ref = (await client.symbols()).resolve("PLC_PRG.copy")

        async def gone_on() -> bool:
            data = (await client.call(Read([(ref.offset, 4)])))[0]
            return int.from_bytes(data, "little") > len(history) + 5

        await until(gone_on)
        assert history == await client.call(ListFlightCycles())
        values = [
            int.from_bytes((await client.call(ReadFlight(cycle, [(ref.offset, 4)])))[0], "little")
            for cycle, _ in history
        ]
        assert values == list(range(1, len(values) + 1))
        recording = read_recording(await client.call(SaveFlight()))
        assert [(one.cycle, one.timestamp_ns) for one in recording.cycles] == history
        status = await client.call(GetFlightStatus())
        assert (status.first_cycle, status.last_cycle) == (history[0][0], history[-1][0])
        assert (status.first_timestamp_ns, status.last_timestamp_ns) == (history[0][1], history[-1][1])
        with pytest.raises(RuntimeRefused, match="is not kept"):
            await client.call(ReadFlight(history[-1][0] + 1_000_000, [(0, 1)]))
        with pytest.raises(RuntimeRefused, match="outside the image"):
            await client.call(ReadFlight(history[0][0], [(1 << 40, 8)]))
        assert not (await client.call(FreezeFlight(False))).frozen
