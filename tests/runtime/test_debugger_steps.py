"""Steps through random programs, against a plain model of the order of their statements."""

import itertools
import random
from collections import Counter

import pytest
from debugger_model import Program, steps
from debugger_programs import at_line, halted, line, loaded, spot, step, until, value

from tappet.runtime.debugger.shapes import BreakpointOrder, Hits


def check_program(seed: int) -> None:
    """Into every statement of a cycle; then over and out from places by chance in the next ones."""
    program = Program(seed)
    events = [program.cycle(), program.cycle(), program.cycle(), program.cycle()]
    plc = loaded(program.text)
    try:
        first = events[0][0][0]
        found = plc.debugger.add(BreakpointOrder(place=spot(first)))
        plc.start()
        assert line(plc) == first
        plc.debugger.remove(found.id)
        passed = [first] + [step(plc, "step_into") for _ in events[0][1:]]
        assert passed == [number for number, _ in events[0]], program.text
        assert step(plc, "step_into") == events[1][0][0], program.text
        chance = random.Random(seed)
        for number in (1, 2):
            cycle, at = events[number], 0
            while True:
                command = chance.choice(["step_into", "step_over", "step_over", "step_out"])
                then = next(steps(cycle, command, at), None)
                expected = events[number + 1][0][0] if then is None else cycle[then][0]
                assert step(plc, command) == expected, (command, at, cycle[at], program.text)
                if then is None:
                    break
                at = then
                depth = len(plc.debugger.stack("Main").frames)
                assert depth == len(cycle[at][1]), (command, cycle[at], program.text)
        shown = {name: value(plc, f"PLC_PRG.{name}") for name in "xyz"}
        halted(plc)
        plc.stop()
        after = {name: value(plc, f"PLC_PRG.{name}") for name in "xyz"}
        assert after == program.memory["PLC_PRG"], program.text
        assert set(shown) == set(after)
    finally:
        plc.close()


def seeds(first: int, count: int) -> list[int]:
    """Of programs whose cycles are neither trivial nor very long."""
    candidates = (seed for seed in itertools.count(first) if 15 <= len(Program(seed).cycle()) <= 250)
    return list(itertools.islice(candidates, count))


@pytest.mark.parametrize("seed", seeds(0, 6))
def test_steps_of_random_programs(seed: int) -> None:
    check_program(seed)


@pytest.mark.slow
@pytest.mark.parametrize("seed", seeds(100, 200))
def test_steps_of_many_random_programs(seed: int) -> None:
    check_program(seed)


@pytest.mark.parametrize("seed", seeds(20, 5))
def test_hits_of_random_programs(seed: int) -> None:
    """A breakpoint at each line counts how often the line is come by, heads of loops at each pass."""
    program = Program(seed)
    cycles = [program.cycle() for _ in range(60)]
    plc = loaded(program.text)
    never = Hits("equal", 1 << 40)
    try:
        numbers = sorted({number for events in cycles for number, _ in events})
        for number in numbers:
            assert plc.debugger.add(at_line(number, never)).actual.line == number
        first = plc.tasks()[0].iec_cycles
        plc.start()
        until(lambda: plc.tasks()[0].iec_cycles > first + 3)
        plc.stop()
        ran = plc.tasks()[0].iec_cycles - first
        passed = Counter(number for events in cycles[:ran] for number, _ in events)
        hits = {b.order.place.line: b.hit_count for b in plc.debugger.state().breakpoints if b.order.place}
        assert hits == {number: passed[number] for number in numbers}, program.text
    finally:
        plc.close()


COMMANDS = (
    "continue", "pause", "step_into", "step_over", "step_out", "run_to", "next_statement", "single_cycle",
    "start", "stop", "reset", "add", "remove", "change", "stack", "write", "settings",
)  # fmt: skip


def run_commands(seed: int, count: int) -> None:
    """Commands by chance: each is answered or refused, and the application is there and runs afterwards."""
    from tappet.runtime.debugger.shapes import Settings
    from tappet.runtime.errors import PlcError

    chance = random.Random(seed)
    program = Program(seed)
    plc = loaded(program.text)
    lines = len(program.lines)
    try:
        plc.start()
        for _ in range(count):
            command = chance.choice(COMMANDS)
            debugger = plc.debugger
            known = [b.id for b in debugger.state().breakpoints]
            place = spot(chance.randint(1, lines + 3))
            try:
                match command:
                    case "start":
                        plc.start()
                    case "stop":
                        plc.stop()
                    case "reset":
                        plc.reset("warm")
                        plc.start()
                    case "add":
                        debugger.add(at_line(chance.randint(1, lines + 3)))
                    case "remove":
                        debugger.remove(chance.choice(known) if known and chance.random() < 0.8 else None)
                    case "change" if known:
                        debugger.change(chance.choice(known), at_line(chance.randint(1, lines)))
                    case "stack":
                        for frame in debugger.stack("Main").frames:
                            debugger.variables("Main", frame.index)
                    case "write":
                        debugger.write("Main", 0, chance.choice("abxy"), chance.randint(0, 9))
                    case "settings":
                        kinds = chance.choice(["keep", "safe"]), chance.choice(["run", "halt"])
                        debugger.set_settings(Settings(*kinds))
                    case "change":
                        pass
                    case _:
                        debugger.control(command, None, place)
            except (PlcError, ValueError):
                pass
        plc.debugger.remove(None)
        plc.stop()
        plc.start()
        before = plc.tasks()[0].iec_cycles
        until(lambda: plc.tasks()[0].iec_cycles > before + 2)
        assert plc.state == "run"
    finally:
        plc.close()


@pytest.mark.parametrize("seed", [1, 2])
def test_commands_by_chance_lose_nothing(seed: int) -> None:
    run_commands(seed, 150)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(10, 18))
def test_a_thousand_commands_by_chance(seed: int) -> None:
    run_commands(seed, 1000)
