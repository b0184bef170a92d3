"""Build properties of an object of CODESYS (dialog Properties > Build), in its two file formats."""

from __future__ import annotations

from collections.abc import Callable

from tappet.project.data import CodeData
from tappet.project.exchange.drafts import Draft, exclude
from tappet.project.exchange.report import ImportReport
from tappet.project.kind_registry import kinds


def take_build_properties(draft: Draft, told: Callable[[str], str], report: ImportReport) -> None:
    """Exclude the object where its properties say so, and report those that mean something else here.

    `told` gives the text of a property by its name, empty where the file does not have it. *Link always*
    needs nothing: what stands in an application is compiled. Nor does *Enable system call*: ADR takes all.
    """
    known = kinds().get(draft.kind)
    if known is None or not issubclass(known.data, CodeData):
        return
    if _is_true(told("ExcludeFromBuild")):
        exclude(draft)
    if _is_true(told("External")) or _is_true(told("ExternalImplementation")):
        note = "its external implementation is a part of the other runtime system; here it needs a body"
        report.add("changed", draft.source, note, name=draft.name, line=draft.line)
    defines = told("CompilerDefines").strip()
    if defines:
        note = f"the compiler defines '{defines}' of its properties are not set; {{define}} in its text does"
        report.add("changed", draft.source, note, name=draft.name, line=draft.line)


def _is_true(text: str) -> bool:
    return text.strip().casefold() == "true"
