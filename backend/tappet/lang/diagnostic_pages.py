"""One manual page for each diagnostic, made from `diagnostics.csv` and the docstrings of the rules.

`python -m tappet.lang.diagnostic_pages [DIR]` writes `<code>.md` for every code and an index to DIR, by
default
docs/diagnostics, and removes pages of codes that are gone. A test fails when they are not what this writes.
"""

from __future__ import annotations

import inspect
import re
import sys
from dataclasses import dataclass
from pathlib import Path

from tappet.lang.diagnostics import TABLE, Entry
from tappet.lang.rules import RULES

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
}
_SECTION = re.compile(r"^(Passes|Fails):\n", re.MULTILINE)


@dataclass(frozen=True, slots=True)
class Sample:
    """A piece of ST from the docstring of a rule."""

    passes: bool
    text: str


@dataclass(frozen=True, slots=True)
class RuleText:
    """The docstring of a rule in its parts."""

    explanation: str
    samples: tuple[Sample, ...]


def rule_text(docstring: str) -> RuleText:
    """Takes the docstring of a rule apart: prose first, then Passes and Fails samples."""
    parts = _SECTION.split(inspect.cleandoc(docstring) + "\n")
    samples = tuple(
        Sample(kind == "Passes", inspect.cleandoc(text) + "\n")
        for kind, text in zip(parts[1::2], parts[2::2], strict=True)
    )
    return RuleText(parts[0].strip(), samples)


def pages() -> dict[str, str]:
    """Text of every page by file name."""
    rules = {code: rule_text(inspect.getdoc(rule) or "") for rule in RULES for code in rule.CODES}
    made = {f"{code}.md": _page(entry, rules.get(code)) for code, entry in TABLE.items()}
    made["README.md"] = _index()
    return made


def _plain(template: str) -> str:
    return template.replace("{{", "{").replace("}}", "}")


def _page(entry: Entry, rule: RuleText | None) -> str:
    lines = [f"# {entry.code}: {entry.name.replace('_', ' ')}", ""]
    lines += [f"**{entry.severity.capitalize()}**: {_plain(entry.message)}", ""]
    lines += [f"**What to do**: {_plain(entry.advice)}", ""]
    if entry.alias:
        lines += [f"CODESYS V3 reports the same as {entry.alias}.", ""]
    if rule is not None:
        lines += [rule.explanation, ""]
        for sample in rule.samples:
            if not sample.passes and entry.code not in sample.text:
                continue
            lines += [
                "Accepted:" if sample.passes else "Reported:",
                "",
                "```iecst",
                sample.text.rstrip(),
                "```",
                "",
            ]
    return "\n".join(lines).rstrip() + "\n"


def _index() -> str:
    lines = [
        "# Messages of the compiler",
        "",
        "Words in braces stand for the names and types of the place.",
        "",
    ]
    group = ""
    for code, entry in sorted(TABLE.items()):
        title = _GROUPS.get(code[:3], "Others")
        heading = f"{title} ({'errors' if code[0] == 'E' else 'warnings and notes'})"
        if heading != group:
            lines += ["", f"## {heading}", "", "| Code | Severity | Message |", "|---|---|---|"]
            group = heading
        message = _plain(entry.message).replace("|", r"\|")
        lines.append(f"| [{code}]({code}.md) | {entry.severity} | {message} |")
    return re.sub(r"\n{3,}", "\n\n", "\n".join(lines)) + "\n"


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
