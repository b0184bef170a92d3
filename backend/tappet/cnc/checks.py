"""What the decoder would refuse, said where the text is: unknown commands, words without sense, jumps.

Spec GC-05 to GC-08, CNC-37, cnc 13. A problem of the parser hides those of its line.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from tappet.cnc.commands import COMMANDS, LAST_M, LIMITLESS, M_WORDS, MODAL, MOST_SWITCHES, Command
from tappet.cnc.words import Line, Problem, Severity, Word

_VARIABLE = -1
"""The travel command, where a variable says it."""
_NO_PLACE = "The switch point has no place; write O (share) or L (distance) behind it"


class _Checks:
    """Goes through lines; remembers the travel command and the block numbers."""

    def __init__(self, in_space: bool) -> None:
        self.travel: int | None = None
        self.space = in_space
        self.numbers: dict[int, int] = {}
        self.jumps: list[tuple[Line, Word]] = []

    def line(self, line: Line) -> Iterator[Problem]:
        if line.number is not None:
            if line.number in self.numbers:
                first = self.numbers[line.number] + 1
                yield Problem(
                    line.place,
                    0,
                    1,
                    f"Line {first} has the block number N{line.number} too; a jump goes there",
                    "warning",
                )
            self.numbers.setdefault(line.number, line.place)
        if any(problem.severity == "error" for problem in line.problems):
            return
        commands = [word for word in line.words if word.address in ("G", "M")]
        if len(commands) > 1:
            yield _at(
                line,
                commands[1],
                "A line has one G or M command; write the second one into a line of its own",
            )
            return
        yield from self._switches(line)
        yield from _repeated(line)
        for word in line.words:
            if word.address in LIMITLESS:
                yield _at(
                    line, word, f"Axis {word.address[1]} has no limits of its own; Z, P, Q, U, V and W have"
                )
            elif word.address == "PROBE" and word.variable is None and word.value not in range(1, 32768):
                yield _at(line, word, "A probe has a number from 1 to 32767")
            yield from _range(line, word)
        if not commands:
            yield from self._modal_line(line)
        elif commands[0].address == "M":
            yield from _function(line, commands[0])
        else:
            yield from self._command(line, commands[0])

    def _command(self, line: Line, word: Word) -> Iterator[Problem]:
        if word.variable is not None:
            self.travel = _VARIABLE
            return
        number = int(word.value)
        command = COMMANDS.get(number)
        if command is None:
            yield _at(line, word, f"G{number} is no command")
        else:
            if command.travels:
                self.travel = number
            if number == 20:
                self.jumps += [(line, target) for target in line.words if target.address == "L"]
            if 15 <= number <= 19:
                self.space = number != 15
            yield from _words(line, f"G{number}", command, word)
            yield from self._element(line, number, word)

    def _modal_line(self, line: Line) -> Iterator[Problem]:
        rest = [word for word in line.words if word.address not in MODAL]
        if not rest:
            return
        if self.travel is None:
            yield _at(line, rest[0], "No line before has a travel command; write one such as G1 in front")
        elif self.travel != _VARIABLE:
            yield from _words(line, f"G{self.travel}", COMMANDS[self.travel], rest[0])
            yield from self._element(line, self.travel, rest[0])

    def _element(self, line: Line, number: int, place: Word) -> Iterator[Problem]:
        """What an arc, ellipse or parabola cannot be."""
        present = {word.address for word in line.words}
        if not present - MODAL - {"G"}:
            return
        if number in (2, 3):
            if not self.space and present & {"R", "I", "J", "K"} == {"K"}:
                yield _at(line, place, f"G{number} needs one of I, J, R; K is no centre in 2D mode")
            if "R" in present and present & {"I", "J", "T", *("K" if self.space else "")}:
                yield _at(line, place, f"G{number} has a radius R, or a centre I, J, K; leave one out")
        elif number in (6, 8, 9) and self.space:
            yield _at(line, place, f"There is no G{number} in 3D mode; write G15 in front, and G17 behind it")

    def _switches(self, line: Line) -> Iterator[Problem]:
        open_switch: Word | None = None
        count = 0
        for word in line.words:
            if word.address == "H":
                if open_switch is not None:
                    yield _at(line, open_switch, _NO_PLACE)
                    return
                open_switch = word
                count += 1
                if word.variable is None and not 1 <= abs(word.value) <= 32767:
                    yield _at(line, word, "A switch has a number from 1, or from -1 down to switch off")
                if count > MOST_SWITCHES:
                    yield _at(line, word, f"A line has {MOST_SWITCHES} switch points at most")
                    return
            elif word.address in ("L", "O"):
                open_switch = None
        if open_switch is not None:
            yield _at(line, open_switch, _NO_PLACE)

    def targets(self) -> Iterator[Problem]:
        """Jumps to blocks that are not there. Spec 1203."""
        for line, word in self.jumps:
            if word.variable is None and word.value not in self.numbers:
                yield _at(line, word, f"No line has the block number N{word.value:g}")


def _repeated(line: Line) -> Iterator[Problem]:
    """A word twice; E may stand there with both signs, L and O belong to switch points."""
    seen: set[str] = set()
    switched = any(word.address == "H" for word in line.words)
    for word in line.words:
        key = word.address
        if key[0] == "E":
            key += "-" if str(word.value).startswith("-") else "+"
        if key == "H" or (switched and key in ("L", "O")) or len(word.address) == 2:
            continue
        if key in seen:
            yield _at(line, word, f"The line has '{word.address}' already")
        seen.add(key)


def _range(line: Line, word: Word) -> Iterator[Problem]:
    """Values that have no sense whatever the line is."""
    if (
        word.variable is None
        and word.value < 0
        and (word.address[0] == "F" or word.address in ("S", "T", "R"))
    ):
        yield _at(line, word, f"'{word.address}' is not below 0")


def _words(line: Line, name: str, command: Command, place: Word) -> Iterator[Problem]:
    """Words that the command does not know, and one that it needs."""
    switched = any(word.address == "H" for word in line.words)
    present = set()
    probed = any(word.address == "PROBE" for word in line.words)
    for word in line.words:
        address = word.address
        if address == "H" and probed and command.probes:
            yield _at(line, word, "A probing movement has no switch points; leave H or PROBE out")
        if address == "G" or address in LIMITLESS or (address == "PROBE" and command.probes):
            continue
        present.add(address)
        stray = "H" in command.words and address in ("L", "O") and not switched
        if stray or (address not in command.words and address not in MODAL):
            yield _at(
                line,
                word,
                f"{name} has no use for '{address}'; write it into a line of its own, or leave it out",
            )
        elif address == "L" and command.numbers is not None and word.variable is None:
            if word.value not in command.numbers:
                yield _at(
                    line, word, f"L of {name} is a number from {command.numbers[0]} to {command.numbers[-1]}"
                )
        elif "O" in command.words and "H" not in command.words and address == "O" and word.variable is None:
            yield _at(line, word, f"O of {name} is a variable, such as O$counter$")
    moves = present - MODAL
    if command.needs and not present & command.needs and (moves or not command.travels):
        yield _at(line, place, f"{name} needs one of {', '.join(sorted(command.needs))}")


def _function(line: Line, word: Word) -> Iterator[Problem]:
    if word.variable is None and not 1 <= word.value <= LAST_M:
        yield _at(line, word, f"The number behind M reaches from 1 to {LAST_M}")
    for other in line.words:
        if other.address != "M" and other.address not in M_WORDS and other.address not in MODAL:
            yield _at(
                line,
                other,
                f"M has no use for '{other.address}'; write it into a line of its own, or leave it out",
            )
        elif other.address == "O" and other.variable is None:
            yield _at(
                line,
                other,
                "O of an M line is a variable of type SMC_M_PARAMETERS, such as O$m$",
            )


def _at(line: Line, word: Word, message: str, severity: Severity = "error") -> Problem:
    return Problem(line.place, word.column, max(word.length, 1), message, severity)


def check(lines: Iterable[Line], *, in_space: bool = False) -> list[Problem]:
    """All problems of a program, those of the parser among them, in the order of the text.

    `in_space`: the program begins in 3D mode.
    """
    checks = _Checks(in_space)
    found: list[Problem] = []
    for line in lines:
        found += line.problems
        found += checks.line(line)
    found += checks.targets()
    return sorted(found, key=lambda problem: (problem.line, problem.column))
