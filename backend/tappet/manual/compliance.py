"""PLCopen's compliance statement: every block and pin of part 1 beside those of the library.

Tables of part 1: `plcopen_pins.csv`, `plcopen_types.csv`, `plcopen_parameters.csv`, written from *Function
blocks for motion control (formerly part 1 and part 2)*, version 2.0, 17 March 2011: sections 2 to 4.
A name in `here` is what the library calls it. Names are compared without case, as IEC 61131-3 does.
"""

from __future__ import annotations

import csv
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cache
from importlib.resources import files

from tappet.libraries import load
from tappet.libraries.catalog import Item, Pin, items
from tappet.libraries.library import Library
from tappet.manual.markdown import joined, table
from tappet.translation.language import Language

LIBRARY = "SM3_Basic"
SECTIONS = {"in_out": "VAR_IN_OUT", "inputs": "VAR_INPUT", "outputs": "VAR_OUTPUT"}
STATES = {
    "Disabled": "power_off",
    "ErrorStop": "errorstop",
    "Stopping": "stopping",
    "Homing": "homing",
    "Standstill": "standstill",
    "DiscreteMotion": "discrete_motion",
    "ContinuousMotion": "continuous_motion",
    "SynchronizedMotion": "synchronized_motion",
}
_PARAMETER = re.compile(r"^\s*([\d, ]+): ParameterOf := Parameter\(ADR\(Axis\.(\w+)\)", re.MULTILINE)


@dataclass(frozen=True, slots=True)
class Row:
    """A pin of PLCopen with the one of the library."""

    block: str
    section: str
    level: str
    """B: basic, E: extended, V: of the vendor."""
    pin: str
    type: str
    here: Pin | None


@dataclass(frozen=True, slots=True)
class Block:
    """A block of PLCopen with the one of the library."""

    name: str
    here: Item | None
    rows: tuple[Row, ...]
    own: tuple[tuple[str, Pin], ...]
    """Pins that only the library has, with their sections."""

    def count(self, level: str) -> tuple[int, int]:
        """How many pins of a level are there, and of how many."""
        rows = [row for row in self.rows if row.level == level]
        return sum(row.here is not None for row in rows), len(rows)

    @property
    def basic(self) -> bool:
        """Whether all basic pins are there."""
        there, of = self.count("B")
        return there == of


@cache
def _table(name: str) -> tuple[dict[str, str], ...]:
    text = files(__package__).joinpath(f"{name}.csv").read_text(encoding="utf-8")
    return tuple(csv.DictReader(text.splitlines()))


def compared(library: Library) -> list[Block]:
    """All blocks of PLCopen, in its order."""
    known = {item.name.upper(): item for item in items(library) if item.kind == "function_block"}
    names = dict.fromkeys(row["block"] for row in _table("plcopen_pins"))
    return [_block(name, known.get(name.upper())) for name in names]


def _block(name: str, here: Item | None) -> Block:
    pins = {
        (section, pin.name.upper()): pin
        for section in SECTIONS
        for pin in (getattr(here, section) if here else ())
    }
    rows = []
    for row in _table("plcopen_pins"):
        if row["block"] == name:
            found = pins.pop((row["section"], (row["here"] or row["pin"]).upper()), None)
            rows.append(Row(name, row["section"], row["level"], row["pin"], row["type"], found))
    return Block(name, here, tuple(rows), tuple((section, pin) for (section, _), pin in pins.items()))


def parameters(library: Library) -> dict[int, str]:
    """Numbers of parameters with the members of an axis that they are."""
    source = next(source for source in library.sources if source.name == "ParameterOf")
    return {
        int(number): member
        for numbers, member in _PARAMETER.findall(source.text)
        for number in numbers.split(",")
    }


def statements() -> dict[str, str]:
    """Text of the statement by its path below `docs/motion`."""
    library = load(LIBRARY)
    return {
        "plcopen-compliance.md": _Statement(library, "en").text(),
        "zh/plcopen-compliance.md": _Statement(library, "zh").text(),
    }


class _Statement:
    """The page in a language."""

    def __init__(self, library: Library, language: Language) -> None:
        self._library = library
        self._items = {item.name: item for item in items(library)}
        self._zh = language == "zh"
        self._pages = "../blocks/zh/" if self._zh else "blocks/"

    def _say(self, english: str, chinese: str) -> str:
        return chinese if self._zh else english

    def text(self) -> str:
        """The whole page."""
        blocks = compared(self._library)
        lines = self._head(blocks) + self._overview(blocks)
        for block in blocks:
            lines += self._pins(block)
        lines += self._types() + self._states() + self._parameters()
        return joined(lines)

    def _head(self, blocks: Sequence[Block]) -> list[str]:
        there = sum(block.here is not None for block in blocks)
        basic = [block.count("B") for block in blocks]
        extended = [block.count("E") for block in blocks]
        facts = {
            "version": self._library.version,
            "there": there,
            "blocks": len(blocks),
            "basic": sum(count for count, _ in basic),
            "of_basic": sum(of for _, of in basic),
            "extended": sum(count for count, _ in extended),
            "of_extended": sum(of for _, of in extended),
        }
        name = "statement_zh.md" if self._zh else "statement_en.md"
        text = files(__package__).joinpath(name).read_text(encoding="utf-8")
        return [text.format(**facts).strip(), ""]

    def _overview(self, blocks: Iterable[Block]) -> list[str]:
        head = (
            self._say("Function block", "功能块"),
            self._say("Supported", "支持"),
            self._say("B pins", "B 级引脚"),
            self._say("E pins", "E 级引脚"),
            self._say("Without", "缺少"),
        )
        rows = []
        for block in blocks:
            basic, extended = (f"{there} / {of}" for there, of in (block.count("B"), block.count("E")))
            absent = [f"`{row.pin}`" for row in block.rows if row.here is None]
            if block.here is None:
                rows.append(
                    (block.name, self._say("no", "否"), basic, extended, self._say("the block", "整个功能块"))
                )
            else:
                how = self._say("yes", "是") if block.basic else self._say("in part", "部分")
                link = f"[{block.name}]({self._pages}{block.here.name}.md)"
                rows.append((link, how, basic, extended, ", ".join(absent)))
        return [f"## {self._say('Function blocks', '功能块')}", "", *table(head, rows), ""]

    def _pins(self, block: Block) -> list[str]:
        head = (
            "",
            self._say("Section", "区段"),
            "PLCopen",
            self._say("Type", "类型"),
            self._say("Supported", "支持"),
            self._say("Here", "此处"),
        )
        rows = [
            (row.level, SECTIONS[row.section], f"`{row.pin}`", row.type, self._yes(row), self._remark(row))
            for row in block.rows
        ]
        rows += [
            ("V", SECTIONS[section], "", "", "", f"`{pin.name}` : {pin.type}") for section, pin in block.own
        ]
        return [f"### {block.name}", "", *table(head, rows), ""]

    def _yes(self, row: Row) -> str:
        return self._say("no", "否") if row.here is None else self._say("yes", "是")

    def _remark(self, row: Row) -> str:
        """What differs."""
        if row.here is None:
            return ""
        name = "" if row.here.name == row.pin else f"`{row.here.name}`"
        same = row.here.type.upper() == row.type.upper()
        kind = "" if same else row.here.type
        return " : ".join(part for part in (name, kind) if part)

    def _types(self) -> list[str]:
        head = (
            "PLCopen",
            self._say("Supported", "支持"),
            self._say("Here", "此处"),
            self._say("Values of PLCopen without a counterpart", "没有对应的 PLCopen 枚举值"),
        )
        rows = []
        for row in _table("plcopen_types"):
            item = self._items.get(row["here"])
            if item is None:
                rows.append((f"`{row['name']}`", self._say("no", "否"), "", ""))
                continue
            known = {value.name.upper().removeprefix("MC") for value in item.values}
            absent = [
                value.partition("=")[0]
                for value in row["values"].split()
                if (value.partition("=")[2] or value.removeprefix("mc")).upper() not in known
            ]
            link = f"[{item.name}]({self._pages}{item.name}.md)"
            rows.append(
                (f"`{row['name']}`", self._say("yes", "是"), link, ", ".join(f"`{one}`" for one in absent))
            )
        return [f"## {self._say('Data types', '数据类型')}", "", *table(head, rows), ""]

    def _states(self) -> list[str]:
        known = {value.name: value.value for value in self._items["SMC_AXIS_STATE"].values}
        head = ("PLCopen", "`SMC_AXIS_STATE`", self._say("Number", "编号"))
        rows = [(state, f"`{here}`", known[here]) for state, here in STATES.items()]
        return [f"## {self._say('Axis states', '轴状态')}", "", *table(head, rows), ""]

    def _parameters(self) -> list[str]:
        here = parameters(self._library)
        head = (
            self._say("Number", "编号"),
            "PLCopen",
            "",
            self._say("Access", "访问"),
            self._say("Supported", "支持"),
            self._say("Here", "此处"),
        )
        rows = []
        for row in _table("plcopen_parameters"):
            member = here.get(int(row["number"]))
            found = self._say("no", "否") if member is None else self._say("yes", "是")
            place = "" if member is None else f"`Axis.{member}`"
            rows.append((row["number"], f"`{row['name']}`", row["level"], row["access"], found, place))
        return [f"## {self._say('Parameters', '参数')}", "", *table(head, rows), ""]
