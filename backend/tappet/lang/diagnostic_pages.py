"""One manual page for each diagnostic, made from `diagnostics.csv`, the docstrings of the rules and samples.

`python -m tappet.lang.diagnostic_pages [DIR]` writes `<code>.md` for every code and an index to DIR, by
default
docs/diagnostics, and removes pages of codes that are gone. A test fails when they are not what this writes.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Sequence
from functools import cache
from pathlib import Path

from tappet.lang.diagnostics import TABLE, Entry
from tappet.lang.rules import all_rules
from tappet.lang.sample_texts import RuleText, Sample, samples, text_of_rule

_GROUPS = {
    "E00": "Characters and literals",
    "E01": "Syntax",
    "E02": "Names",
    "E03": "Types and values",
    "E04": "Declarations",
    "E05": "Calls",
    "E06": "Layout and addresses",
    "E07": "Tasks",
    "E08": "Statements",
    "E09": "Code generation",
    "W10": "Conversions",
    "W11": "Statements and expressions",
    "W12": "Declarations",
    "W13": "Addresses",
    "W14": "Tasks",
    "W15": "Texts",
    "S10": "Coding rules: names",
    "S11": "Coding rules: comments and declarations",
    "S12": "Coding rules: statements and expressions",
    "S13": "Coding rules: size and structure",
    "S14": "Coding rules: use of data and blocks",
    "S15": "Coding rules: tasks",
    "S16": "Coding rules: portability",
}


@cache
def _explanations() -> dict[str, RuleText]:
    return {code: text_of_rule(rule) for rule in all_rules() for code in rule.CODES}


def explanation_of(code: str) -> str | None:
    """Why there is the message, where a rule says so."""
    rule = _explanations().get(code)
    return None if rule is None else rule.explanation


def samples_of(code: str) -> tuple[Sample, ...]:
    """Programs that are accepted and programs that are reported."""
    return tuple(samples().get(code, ()))


def pages() -> dict[str, str]:
    """Text of every page by file name."""
    rules = _explanations()
    made = {f"{code}.md": _page(entry, rules.get(code), samples_of(code)) for code, entry in TABLE.items()}
    made["README.md"] = _index()
    made["codesys.md"] = _numbers()
    return made


def _plain(template: str) -> str:
    return template.replace("{{", "{").replace("}}", "}")


def _page(entry: Entry, rule: RuleText | None, shown: Sequence[Sample]) -> str:
    lines = [f"# {entry.code}: {entry.name.replace('_', ' ')}", ""]
    lines += [f"**{entry.severity.capitalize()}**: {_plain(entry.message)}", ""]
    lines += [f"**What to do**: {_plain(entry.advice)}", ""]
    if entry.aliases:
        lines += [f"CODESYS V3 reports the same as {', '.join(entry.aliases)}.", ""]
    if rule is not None:
        lines += [rule.explanation, ""]
    for sample in shown:
        lines += ["Accepted:" if sample.passes else "Reported:", ""]
        lines += ["```iecst", as_text(sample.text), "```", ""]
    return "\n".join(lines).rstrip() + "\n"


def as_text(text: str) -> str:
    """A sample as a reader takes it: the `@` lines become comments."""
    lines = text.rstrip().splitlines()
    return "\n".join(f"// {line[1:]}" if line.startswith("@") else line for line in lines)


def _index() -> str:
    lines = [
        "# Messages of the compiler",
        "",
        "Words in braces stand for the names and types of the place. A page of its own says",
        "[what the rules of CODESYS Static Analysis are called here](codesys.md).",
        "",
    ]
    group = ""
    for code, entry in sorted(TABLE.items()):
        title = _GROUPS.get(code[:3], "Others")
        heading = f"{title} ({'errors' if code[0] == 'E' else 'warnings and notes'})"
        if heading != group:
            lines += ["", f"## {heading}", "", "| Code | Severity | CODESYS | Message |", "|---|---|---|---|"]
            group = heading
        message = _plain(entry.message).replace("|", r"\|")
        numbers = ", ".join(entry.aliases)
        lines.append(f"| [{code}]({code}.md) | {entry.severity} | {numbers} | {message} |")
    return re.sub(r"\n{3,}", "\n\n", "\n".join(lines)) + "\n"


_NOT_CHECKED = {
    "SA0005": "Invalid addresses and data types: errors of the compiler (E0601 and those behind it).",
    "SA0063": "Operations that a 16-bit controller cuts: every target here computes narrow integers in 32"
    " bits or more; W1010 and S1241 report where that is seen.",
    "SA0077": "Types that do not fit the CASE: errors of the compiler (E0301, E0805, E0806).",
    "SA0179": "Coupling between objects: a number of the whole design that no place of the text answers for;"
    " the cross references show who uses an object.",
    "SA0181": "Forbidden symbols: a list of names that each project would keep for itself."
    " {attribute 'obsolete'} above an object warns at each use of it (W1203).",
}
"""Rules of CODESYS Static Analysis that are none here, and why."""


def _numbers() -> str:
    """What the numbers of CODESYS Static Analysis are here, for those who know them and for their pragmas."""
    found: dict[str, list[str]] = {number: [] for number in _NOT_CHECKED}
    for entry in TABLE.values():
        for alias in entry.aliases:
            if alias.startswith("SA"):
                found.setdefault(alias, []).append(entry.code)
    lines = [
        "# Rules of CODESYS Static Analysis",
        "",
        "A pragma `{analysis -33}` or `{attribute 'analysis' := '-33'}` switches off what has the number",
        "SA0033. W codes are always on, S codes when the application has chosen them, E codes are errors.",
        "",
        "| CODESYS | Here | What it says |",
        "|---|---|---|",
    ]
    for number, codes in sorted(found.items()):
        for code in sorted(codes):
            message = _plain(TABLE[code].message).replace("|", r"\|")
            lines.append(f"| {number} | [{code}]({code}.md) | {message} |")
        if not codes:
            lines.append(f"| {number} | none | {_NOT_CHECKED[number]} |")
    return "\n".join(lines) + "\n"


def write(directory: Path) -> None:
    """Writes all pages to `directory` and removes pages of codes that do not exist any more."""
    directory.mkdir(parents=True, exist_ok=True)
    made = pages()
    for old in directory.glob("*.md"):
        if old.name not in made:
            old.unlink()
    for name, text in made.items():
        (directory / name).write_text(text, encoding="utf-8")


if __name__ == "__main__":
    write(Path(sys.argv[1] if len(sys.argv) > 1 else "docs/diagnostics"))
