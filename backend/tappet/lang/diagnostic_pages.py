"""One manual page for each diagnostic, made from `diagnostics.csv`, the docstrings of the rules and samples.

`python -m tappet.lang.diagnostic_pages [DIR]` writes `<code>.md` for every code and an index to DIR, by
default
docs/diagnostics, and removes pages of codes that are gone. A test fails when they are not what this writes.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Sequence
from pathlib import Path

from tappet.lang.diagnostics import TABLE, Entry
from tappet.lang.rules import ALL_RULES
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
}


def pages() -> dict[str, str]:
    """Text of every page by file name."""
    rules = {code: text_of_rule(rule) for rule in ALL_RULES for code in rule.CODES}
    found = samples()
    made = {f"{code}.md": _page(entry, rules.get(code), found.get(code, ())) for code, entry in TABLE.items()}
    made["README.md"] = _index()
    return made


def _plain(template: str) -> str:
    return template.replace("{{", "{").replace("}}", "}")


def _page(entry: Entry, rule: RuleText | None, shown: Sequence[Sample]) -> str:
    lines = [f"# {entry.code}: {entry.name.replace('_', ' ')}", ""]
    lines += [f"**{entry.severity.capitalize()}**: {_plain(entry.message)}", ""]
    lines += [f"**What to do**: {_plain(entry.advice)}", ""]
    if entry.alias:
        lines += [f"CODESYS V3 reports the same as {entry.alias}.", ""]
    if rule is not None:
        lines += [rule.explanation, ""]
    for sample in shown:
        lines += ["Accepted:" if sample.passes else "Reported:", ""]
        lines += ["```iecst", _as_text(sample.text), "```", ""]
    return "\n".join(lines).rstrip() + "\n"


def _as_text(text: str) -> str:
    """A sample as a reader takes it: the `@` lines become comments."""
    lines = text.rstrip().splitlines()
    return "\n".join(f"// {line[1:]}" if line.startswith("@") else line for line in lines)


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
            lines += ["", f"## {heading}", "", "| Code | Severity | CODESYS | Message |", "|---|---|---|---|"]
            group = heading
        message = _plain(entry.message).replace("|", r"\|")
        lines.append(f"| [{code}]({code}.md) | {entry.severity} | {entry.alias} | {message} |")
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
