"""One object is taken out of a correct project: its references are reported, nothing that follows of them.

Members, calls and conversions of what is unknown are silent; the name of the object stands at every error.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import pytest

from tappet import libraries
from tappet.lang import ast
from tappet.lang.analysis import AnalysisOptions, analyse
from tappet.lang.conditional import ParseOptions, parse_sources
from tappet.lang.diagnostics import Diagnostic
from tappet.lang.source import Source, text_at
from tappet.lang.system_structures import TWINCAT_TYPES

ROOT = Path(__file__).resolve().parents[2]
UNKNOWN = {"E0201", "E0202", "E0211", "E0216", "E0217", "E0218", "E0606"}
"""Codes of the messages about a name that nothing declares."""


def _correct_texts() -> list[tuple[str, str]]:
    """Programs of the conformance tests that are accepted, the largest corpus of small correct projects."""
    found = []
    for path in sorted((ROOT / "tests" / "conformance").rglob("*.st")):
        text = path.read_text(encoding="utf-8")
        if not re.search(r"^\s*// ERROR:", text, re.MULTILINE):
            found.append((path.stem, text))
    for path in sorted((ROOT / "tests" / "spec" / "rules").glob("*.st")):
        for number, case in enumerate(re.split(r"^// CASE ", path.read_text(encoding="utf-8"), flags=re.M)):
            if not re.search(r"^// (ERROR|SOURCE):", case, re.MULTILINE):
                found.append((f"{path.stem}_{number}", "// " + case))
    return found


TEXTS = _correct_texts()
STANDARD = libraries.load("Standard").sources
UTIL = libraries.load("Util").sources


@dataclass(frozen=True)
class Removal:
    """What is taken out of a text, and the names that go with it."""

    name: str
    names: frozenset[str]


def _names(declaration: ast.Declaration) -> frozenset[str]:
    found = {declaration.name.upper()}
    blocks = declaration.blocks if isinstance(declaration, (ast.GlobalList, ast.Pou)) else []
    variables = [v for block in blocks for v in block.variables]
    if isinstance(declaration, ast.GlobalList):
        found |= {v.name.upper() for v in variables}
    refs = (
        [declaration.type_ref] if isinstance(declaration, ast.TypeDecl) else [v.type_ref for v in variables]
    )
    for ref in refs:
        if isinstance(ref, ast.EnumType):
            found |= {value.name.upper() for value in ref.values}
    return frozenset(found)


def _diagnose(sources: Sequence[Source], without: str | None = None) -> list[Diagnostic]:
    results = parse_sources(sources, ParseOptions())
    for result in results:
        kept = [d for d in result.unit.declarations if without is None or d.name.upper() != without]
        result.unit.declarations[:] = kept
    return [
        d for d in analyse([r.unit for r in results], AnalysisOptions()).diagnostics if d.severity == "error"
    ]


def _removals(sources: Sequence[Source]) -> Iterator[Removal]:
    """Every declaration whose names nothing else has: what is left would mean something else by them."""
    declarations = [d for r in parse_sources(sources, ParseOptions()) for d in r.unit.declarations]
    times = Counter(name for d in declarations for name in _names(d))
    for declaration in declarations:
        names = _names(declaration)
        if all(times[name] == 1 for name in names) and not names & set(TWINCAT_TYPES):
            yield Removal(declaration.name.upper(), names)


def _follow_ups(found: Sequence[Diagnostic], sources: Sequence[Source], missing: frozenset[str]) -> list[str]:
    """Errors that do not name what is missing at their place."""
    texts = {source.uri: source for source in sources}
    wrong = []
    for d in found:
        written = set(re.findall(r"\w+", text_at(texts[d.uri], d.span).upper()))
        # IL writes modifiers behind the name of a function
        written |= {word[: -len(end)] for word in written for end in ("C", "N", "CN") if word.endswith(end)}
        if d.code not in UNKNOWN or not written & missing:
            wrong.append(str(d))
    return wrong


@pytest.mark.parametrize(("name", "text"), TEXTS, ids=[name for name, _ in TEXTS])
def test_only_references_to_what_is_taken_out_are_reported(name: str, text: str) -> None:
    sources = [Source(name, text)]
    if _diagnose(sources):
        pytest.skip("needs libraries or settings")
    for removal in _removals(sources):
        wrong = _follow_ups(_diagnose(sources, removal.name), sources, removal.names)
        assert not wrong, (removal.name, wrong)


def test_only_references_to_objects_of_a_library_that_is_taken_out_are_reported() -> None:
    missing = frozenset(name for removal in _removals(STANDARD) for name in removal.names) | {"STANDARD"}
    users = 0
    for name, text in TEXTS:
        sources = [Source(name, text), *STANDARD]
        without = _diagnose(sources[:1])
        if without and not _diagnose(sources):
            users += 1
            assert not _follow_ups(without, sources, missing), name
    assert users > 10


def test_only_references_to_what_is_taken_out_of_a_library_are_reported() -> None:
    sources = [*STANDARD, *UTIL]
    assert not _diagnose(sources)
    for removal in _removals(sources):
        wrong = _follow_ups(_diagnose(sources, removal.name), sources, removal.names)
        assert not wrong, (removal.name, wrong)


UNKNOWN_HERITAGE = """
INTERFACE IX EXTENDS INope METHOD A : INT END_METHOD END_INTERFACE
FUNCTION_BLOCK FB EXTENDS FB_Nope IMPLEMENTS IX, IOther
VAR_INPUT i : INT; END_VAR
VAR t : T_Nope; u : Lib.FB_X; arr : ARRAY[0..gMax] OF T_Nope; p : POINTER TO FB_Nope2; e : E_Nope;
END_VAR
base := 3; Run(1, x := 2); SUPER^(a := 4); THIS^.zz := 5; i := t.x + u.y(3) + arr[2].z; p^.Do(); p^.k := 3;
u(a := 1, b => i);
CASE e OF E_Nope.One: i := 1; END_CASE
FOR cnt := 0 TO 5 DO i := cnt; END_FOR
IF t.flag AND u.q THEN i := 3; END_IF
i := F_Nope(3, t) + 1; t.a.b[3].c := i; t := F_Nope(1); i := SEL(t.b, 1, 2); i := LIMIT(0, t.n, 10);
i := TO_INT(t.r); i := REAL_TO_INT(u.v); i := SIZEOF(t); p := ADR(t); p := __NEW(FB_Nope2);
i := -t.x; t.q := NOT t.q;
METHOD OVERRIDE A : INT
A := SUPER^.A();
END_METHOD
METHOD PROTECTED OVERRIDE C : T_Nope
END_METHOD
PROPERTY Place : T_Nope GET Place := t; END_GET END_PROPERTY
END_FUNCTION_BLOCK
TYPE S EXTENDS S_Nope : STRUCT a : INT; END_STRUCT END_TYPE
TYPE Renamed : T_Nope; END_TYPE
FUNCTION_BLOCK G EXTENDS FB
METHOD D : INT
D := foo; bar(); SUPER^.D();
END_METHOD
END_FUNCTION_BLOCK
PROGRAM Main
VAR f : FB(1,2) := (i := 3, q := 4); g : G; s : S := (a := 1, zz := 2); ix : IX; x : INT;
al : Renamed; io : IOther;
END_VAR
f(i := 3, j := 4, k => x); f.foo(); x := f.bar; g.q(1,2,3); s.zz := 3; ix := f; ix := g; ix.M(); x := ix.Q;
al.z := 3; io := f; io.Do(); x := g.Place.x; g.i := f.Place;
END_PROGRAM
"""


def test_nothing_is_said_about_what_may_come_from_an_unknown_base() -> None:
    source = Source("heritage", UNKNOWN_HERITAGE)
    missing = frozenset({"INOPE", "FB_NOPE", "FB_NOPE2", "IOTHER", "T_NOPE", "LIB", "E_NOPE", "S_NOPE"})
    found = _diagnose([source])
    assert not _follow_ups(found, [source], missing)
    assert len({(d.span.line, d.span.column) for d in found}) == len(found)
