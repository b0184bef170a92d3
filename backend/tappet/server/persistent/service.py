"""Which instance paths a list of persistent variables lacks, and its text with them."""

from __future__ import annotations

import re

from tappet.codegen.package import CodePackage
from tappet.iec.tokens import code_of
from tappet.project.naming import name_key

_PATH = re.compile(r"^[ \t]*(\w+(?:\.\w+)+)[ \t]*:", re.MULTILINE)
_END = re.compile(r"\bEND_VAR\b", re.IGNORECASE)
HEADING = "    // Instance paths"


def missing_paths(declaration: str, name: str, package: bytes) -> list[tuple[str, str]]:
    """Paths and types of the persistent variables of instances that the list does not name, in the order of
    the application. Elements of arrays cannot stand in a list; they are kept without it."""
    found = CodePackage.from_bytes(package)
    known = {name_key(path) for path in _PATH.findall(code_of(declaration))}
    missing = []
    for variable in found.persistent:
        path = variable.path
        if name_key(path.partition(".")[0]) == name_key(name) or "[" in path or name_key(path) in known:
            continue
        missing.append((path, found.symbols.resolve(path).type.name))
    return missing


def with_paths(declaration: str, paths: list[tuple[str, str]]) -> str:
    """The list with further paths at its end, so that those that are there keep their order."""
    ends = list(_END.finditer(declaration))
    rows = [HEADING] if HEADING.strip() not in declaration else []
    rows += [f"    {path} : {type_name};" for path, type_name in paths]
    if not ends:
        return "\n".join([declaration.rstrip("\n"), "VAR_GLOBAL PERSISTENT RETAIN", *rows, "END_VAR"]).lstrip(
            "\n"
        )
    at = declaration.rfind("\n", 0, ends[-1].start()) + 1
    if declaration[at : ends[-1].start()].strip():
        at = ends[-1].start()
        rows.insert(0, "")
    return declaration[:at] + "\n".join(rows) + "\n" + declaration[at:]
