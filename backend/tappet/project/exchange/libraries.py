"""References to libraries of other systems: those that are here under another name get that name."""

from __future__ import annotations

from tappet.project.exchange.report import ImportReport

_SAME = {"tc2_standard": "Standard", "iec_standard": "Standard"}
"""Libraries whose contents are in one of ours; the file's namespace is kept for qualified names."""


def tell_parameters(
    source: str, name: str, given: list[str], report: ImportReport, line: int | None = None
) -> None:
    """Say that values for the parameters of a library are not read."""
    if given:
        text = f"parameters of libraries are not read: {', '.join(given)} keep their own values"
        report.add("changed", source, text, name=name, line=line)


def reference(
    source: str, name: str, version: str, namespace: str, report: ImportReport, line: int | None = None
) -> dict[str, str]:
    """The data of a library reference. Versions of other systems say nothing here, so any will do."""
    ours = _SAME.get(name.casefold())
    if ours is not None:
        report.add("changed", source, f"the library became '{ours}'", name=name, line=line)
        return {"name": ours, "version": "*", "namespace": namespace or name}
    if version not in ("*", "") and name.casefold() != "standard":
        text = f"version {version} is not asked for: any version is taken"
        report.add("changed", source, text, name=name, line=line)
    return {"name": name, "version": "*", "namespace": "" if namespace == name else namespace}
