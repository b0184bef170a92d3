"""The samples of every message: those in the docstrings of rules, and those in `samples/*.txt`.

A sample is one or more objects, or the declarations and statements of a program, with types before them.
Lines that begin with `@` set the stage:

    @source NAME [pous | library NAMESPACE [qualified_only] | owner POU]    another text begins
    @task NAME KIND INTERVAL_MS PRIORITY EVENT|- PROGRAM ...
    @watchdog TASK TIME_MS SENSITIVITY
    @language IL     the bodies of this text are IL
    @references LIBRARY ...    libraries the application refers to
    @tasks none      there is no task, and this is checked
    @frames N        so many nested calls are left to the analysis
    @build           code is generated
    @static          the coding rules are switched on
"""

from __future__ import annotations

import inspect
import re
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from types import ModuleType

from tappet.lang.rules import all_rules

_SECTION = re.compile(r"^(Passes|Fails):\n", re.MULTILINE)
_CODE = re.compile(r"[EWS]\d{4}")


@dataclass(frozen=True, slots=True)
class Sample:
    """A piece of ST with the codes it belongs to: all of them are reported, or none."""

    passes: bool
    text: str
    codes: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class RuleText:
    """The docstring of a rule in its parts."""

    explanation: str
    samples: tuple[Sample, ...]


def rule_text(docstring: str, codes: tuple[str, ...] = ()) -> RuleText:
    """Takes the docstring of a rule apart: prose first, then Passes and Fails samples."""
    parts = _SECTION.split(inspect.cleandoc(docstring) + "\n")
    samples = []
    for kind, text in zip(parts[1::2], parts[2::2], strict=True):
        body = inspect.cleandoc(text) + "\n"
        named = tuple(dict.fromkeys(_CODE.findall(body)))
        samples.append(Sample(kind == "Passes", body, codes if kind == "Passes" else named))
    return RuleText(parts[0].strip(), tuple(samples))


def text_of_rule(rule: ModuleType) -> RuleText:
    """The docstring of a rule in its parts."""
    return rule_text(inspect.getdoc(rule) or "", rule.CODES)


def read_samples(text: str) -> list[Sample]:
    """The samples of one text file."""
    found: list[Sample] = []
    code, passes, lines = "", False, list[str]()

    def end() -> None:
        body = "\n".join(lines).strip("\n")
        if code and body:
            found.append(Sample(passes, body + "\n", (code,)))
        lines.clear()

    for line in text.splitlines():
        if line.startswith("=== "):
            end()
            code, passes = line[4:].strip(), False
        elif line.startswith("--- accepted"):
            end()
            passes = True
        else:
            lines.append(line)
    end()
    return found


@cache
def samples() -> dict[str, tuple[Sample, ...]]:
    """The samples of every code."""
    found: dict[str, list[Sample]] = {}
    for rule in all_rules():
        for sample in text_of_rule(rule).samples:
            for code in sample.codes:
                found.setdefault(code, []).append(sample)
    folder = files("tappet.lang.samples")
    for entry in sorted(folder.iterdir(), key=lambda e: e.name):
        if entry.name.endswith(".txt"):
            for sample in read_samples(entry.read_text(encoding="utf-8")):
                found.setdefault(sample.codes[0], []).append(sample)
    return {code: tuple(entries) for code, entries in found.items()}
