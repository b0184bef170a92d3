"""A page for each block, function and type of the motion libraries, and an index, in English and Chinese."""

from __future__ import annotations

import csv
import re
from collections.abc import Iterable, Mapping, Sequence
from functools import cache
from importlib.resources import files

from tappet.libraries import load
from tappet.libraries.catalog import Item, NamedValue, Pin, items
from tappet.libraries.library import Library
from tappet.manual.examples import CYCLE_MS, Example
from tappet.manual.library_errors import errors_of
from tappet.manual.markdown import joined, table
from tappet.manual.words import GROUPS, group, state, word
from tappet.translation.language import Language
from tappet.translation.library_comments import said

LIBRARY = "SM3_Basic"
CAM_BUILDER = "SM3_CamBuilder"
CNC = "SM3_CNC"
FOLDERS = {LIBRARY: "blocks", CAM_BUILDER: "cam-builder", CNC: "cnc"}
"""Where the pages of a library lie, by the library."""

LANGUAGES: tuple[Language, ...] = ("en", "zh")
_SECTIONS = (("in_out", "in_out"), ("inputs", "inputs"), ("outputs", "outputs"))
_POUS = ("function_block", "function", "program")
_EXTENDS = re.compile(r"^FUNCTION_BLOCK\s+(?:(?:INTERNAL|ABSTRACT)\s+)*\w+\s+EXTENDS\s+(\w+)", re.MULTILINE)
_IDENTIFIER = re.compile(r"[A-Za-z_]\w*")


def examples_of(library: str) -> str:
    """The folder of the examples of a library, below `docs/motion`."""
    return "examples" if library == LIBRARY else f"examples/{FOLDERS[library]}"


def sentences_of_examples(library: str) -> str:
    """Table of the sentences of the examples of a library."""
    return f"{library}_examples"


def pages(library: str, examples: Mapping[str, Example]) -> dict[str, str]:
    """Text of every page of a library by its path below `docs/motion`."""
    made: dict[str, str] = {}
    for language in LANGUAGES:
        manual = _Manual(library, examples, language)
        for item in manual.items.values():
            made[f"{manual.folder}/{item.name}.md"] = manual.page(item)
        made[f"{manual.folder}/README.md"] = manual.index()
    return made


@cache
def _rows() -> dict[str, dict[str, str]]:
    text = files(__package__).joinpath("blocks.csv").read_text(encoding="utf-8")
    return {row["name"]: row for row in csv.DictReader(text.splitlines())}


def items_of(library: str) -> list[Item]:
    """The items of a library that the manual has: of SM3_CNC those with a row in `blocks.csv`."""
    return [item for item in items(load(library)) if library != CNC or item.name in _rows()]


def group_of(item: Item) -> str:
    """Key of the group in which the index shows an item."""
    if item.kind not in _POUS:
        return "types"
    return _rows().get(item.name, {}).get("group", "other")


def _group_in(library: str, item: Item) -> str:
    """What the cam builder is about is one group."""
    return "cams" if library == CAM_BUILDER and item.kind in _POUS else group_of(item)


def _text_of(library: Library, name: str) -> str:
    return next((source.text for source in library.sources if source.name == name), "")


def public_methods(library: Library, item: Item) -> list[Item]:
    """The methods that programs may call."""
    text = _text_of(library, item.name)
    return [one for one in item.methods if re.search(rf"\bMETHOD\s+((PUBLIC|FINAL)\s+)*{one.name}\b", text)]


def state_of(name: str) -> str:
    """Key of what a block does to the state of its axis; empty for what has no axis."""
    return _rows().get(name, {}).get("state", "")


class _Manual:
    """The pages in a language."""

    def __init__(self, library: str, examples: Mapping[str, Example], language: Language) -> None:
        self.items = {item.name: item for item in items_of(library)}
        self.folder = FOLDERS[library] + ("/zh" if language == "zh" else "")
        self._name = library
        self._library = load(library)
        basic = {item.name: item for item in items(load(LIBRARY))}
        self._basic = {} if library == LIBRARY else basic
        self._examples = examples
        self._language = language
        self._up = "../../" if language == "zh" else "../"
        self._numbers = {
            value.name: (number, value.comment) for value, number in _numbered(basic["SMC_ERROR"])
        }
        self._users: dict[str, set[str]] = {}
        for item in self.items.values():
            for pin in (*item.inputs, *item.outputs, *item.in_out, *item.members):
                for name in _IDENTIFIER.findall(pin.type):
                    if name in self.items and name != item.name:
                        self._users.setdefault(name, set()).add(item.name)

    def page(self, item: Item) -> str:
        """The page of an item."""
        lines = [f"# {item.name}", ""]
        kind = self._word(item.kind)
        kind = kind[0].upper() + kind[1:]
        where = (
            f"{kind}{self._word('comma')}[{group(_group_in(self._name, item), self._language)}](README.md)"
        )
        other = self._word("other language", page=f"{item.name}.md")
        lines += [f"{where} · [{self._word('source')}]({self._up}{self._source(item)}) · {other}", ""]
        for paragraph in self._paragraphs(item.summary):
            lines += [paragraph, ""]
        lines += self._form(item)
        lines += self._state(item) + self._errors(item) + self._example(item)
        users = sorted(self._users.get(item.name, ()), key=str.upper)
        if users and item.name != "AXIS_REF_SM3":
            lines += [
                f"## {self._word('used by')}",
                "",
                ", ".join(f"[{name}]({name}.md)" for name in users),
                "",
            ]
        return joined(lines)

    def _extended(self, name: str) -> str | None:
        """The next public block that a block extends, over INTERNAL ones."""
        found = _EXTENDS.search(_text_of(self._library, name))
        if found is None:
            return None
        return found[1] if found[1] in self.items else self._extended(found[1])

    def _form(self, item: Item) -> list[str]:
        lines: list[str] = []
        extended = self._extended(item.name) if item.kind == "function_block" else None
        if extended is not None:
            lines += [self._word("extends", type=f"[{extended}]({extended}.md)"), ""]
        if item.returns and item.kind in ("function", "alias"):
            lines += [
                self._word("returns" if item.kind == "function" else "stands for", type=item.returns),
                "",
            ]
        for section, heading in _SECTIONS:
            lines += self._pins(self._word(heading), getattr(item, section))
        lines += self._pins(
            self._word("parameters" if item.kind == "parameter_list" else "members"), item.members
        )
        if item.values:
            head = (self._word("name"), self._word("number"), self._word("meaning"))
            rows = [
                (f"`{value.name}`", number, self._say(value.comment)) for value, number in _numbered(item)
            ]
            lines += [f"## {self._word('values')}", "", *table(head, rows), ""]
        for method in public_methods(self._library, item):
            if not (method.summary or method.inputs or method.outputs or method.in_out):
                continue  # that of the block it extends, in another way
            lines += [f"## {self._word('methods')}: {method.name}", ""]
            lines += [self._say(method.summary), ""]
            if method.returns:
                lines += [self._word("returns", type=method.returns.replace(f"{LIBRARY}.", "")), ""]
            for section, heading in _SECTIONS:
                lines += self._pins(self._word(heading), getattr(method, section), "###")
        return lines

    def _pins(self, heading: str, pins: Sequence[Pin], level: str = "##") -> list[str]:
        if not pins:
            return []
        head = (self._word("name"), self._word("type"), self._word("default"), self._word("meaning"))
        rows = [
            (f"`{pin.name}`", self._type(pin.type), _code(pin.default), self._say(pin.comment))
            for pin in pins
        ]
        return [f"{level} {heading}", "", *table(head, rows), ""]

    def _state(self, item: Item) -> list[str]:
        key = state_of(item.name)
        if not key:
            return []
        return [f"## {self._word('state')}", "", state(key, self._language), ""]

    def _errors(self, item: Item) -> list[str]:
        if item.kind != "function_block" or all(pin.type != "SMC_ERROR" for pin in item.outputs):
            return []
        found = sorted(
            (int(self._numbers[name][0]), name)
            for name in errors_of(self._library, item.name)
            if name in self._numbers
        )
        if not found:
            return []
        head = (self._word("number"), self._word("name"), self._word("meaning"))
        rows = [(str(number), f"`{name}`", self._say(self._numbers[name][1])) for number, name in found]
        return [f"## {self._word('errors')}", "", self._word("own errors"), "", *table(head, rows), ""]

    def _example(self, item: Item) -> list[str]:
        example = self._examples.get(item.name)
        if example is None:
            return []
        file = f"{self._up}{examples_of(self._name)}/{item.name}.st"
        names = ", ".join(f"`{name}`" for name in example.axes)
        key = "axis" if len(example.axes) == 1 else "axes" if example.axes else "no axis"
        axes = self._word(key, name=example.axes[0] if example.axes else "", names=names)
        lines = []
        if example.charted:
            chart = f"{'../' if self._language == 'zh' else ''}charts/{item.name}.svg"
            lines += [
                f"## {self._word('timing')}",
                "",
                f"![{self._word('timing')}: {item.name}]({chart})",
                "",
            ]
            lines += [self._word("chart", cycles=example.cycles, cycle=CYCLE_MS), ""]
        lines += [
            f"## {self._word('example')}",
            "",
            self._say(example.comment, sentences_of_examples(self._name)),
            "",
        ]
        lines += [
            self._word("example text", axes=axes, file=file),
            "",
            "```iecst",
            example.program,
            "```",
            "",
        ]
        return lines

    def index(self) -> str:
        """The index in groups, behind the rules that hold for all blocks."""
        name = "rules" if self._name == LIBRARY else FOLDERS[self._name].replace("-", "_")
        rules = files(__package__).joinpath(f"{name}_{self._language}.md").read_text(encoding="utf-8")
        lines = [f"# {self._word('title', library=self._name)}", ""]
        lines += [self._word("other language", page="README.md"), ""]
        if self._name == LIBRARY:
            lines += [self._word("intro", cycle=CYCLE_MS), "", f"## {self._word('general')}", ""]
        lines += [rules.strip(), ""]
        head = (self._word("name"), self._word("kind"), self._word("what"))
        for key in GROUPS:
            members = [item for item in self.items.values() if _group_in(self._name, item) == key]
            rows = [
                (f"[{item.name}]({item.name}.md)", self._word(item.kind), self._first(item))
                for item in members
            ]
            if rows:
                lines += [f"## {group(key, self._language)}", "", *table(head, rows), ""]
        return joined(lines)

    def _first(self, item: Item) -> str:
        """The first sentence of what an item is."""
        return next(iter(self._paragraphs(item.summary)), "")

    def _type(self, text: str) -> str:
        """A type with links to the pages of its parts."""

        text = text.replace(f"{LIBRARY}.", "")

        def linked(match: re.Match[str]) -> str:
            name = match.group()
            if name in self._basic:
                return f"[{name}]({self._basic_page(name)})"
            return f"[{name}]({name}.md)" if name in self.items else name

        if not any(name in self.items or name in self._basic for name in _IDENTIFIER.findall(text)):
            return f"`{text}`"
        return _IDENTIFIER.sub(linked, text.replace("[", r"\[").replace("]", r"\]"))

    def _basic_page(self, name: str) -> str:
        """A page of SM3_Basic, from one of another library."""
        language = "zh/" if self._language == "zh" else ""
        return f"{self._up}{FOLDERS[LIBRARY]}/{language}{name}.md"

    def _source(self, item: Item) -> str:
        return f"../../backend/tappet/libraries/{self._name}/{item.name}.st"

    def _word(self, key: str, **facts: object) -> str:
        return word(key, self._language, **facts)

    def _say(self, comment: str, library: str | None = None) -> str:
        between = "" if self._language == "zh" else " "
        return between.join(said(comment, library or self._name, self._language))

    def _paragraphs(self, comment: str) -> list[str]:
        """The first sentence of a comment, and what it goes on with."""
        found = said(comment, self._name, self._language)
        between = "" if self._language == "zh" else " "
        return [text for text in (between.join(found[:1]), between.join(found[1:])) if text]


def _numbered(item: Item) -> Iterable[tuple[NamedValue, str]]:
    """The values of an enumeration with their numbers."""
    number = -1
    for value in item.values:
        number = int(value.value) if value.value else number + 1
        yield value, str(number)


def _code(text: str) -> str:
    return f"`{text}`" if text else ""
