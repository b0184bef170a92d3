"""Builds after edits, with one session, give what a build of everything gives: messages, values, lines."""

from __future__ import annotations

import io
from collections.abc import Iterator
from dataclasses import dataclass, field

import pytest
from compiled_programs import change_over, running
from elftools.elf.elffile import ELFFile
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from tappet.codegen import partition
from tappet.codegen.build import BuildOptions, BuildResult, BuildSession, build_application
from tappet.codegen.jit import ApplicationFault, LoadedApplication
from tappet.codegen.package import CodePackage, TaskSpec
from tappet.core.lower import lower_pou
from tappet.core.program import LoweringError, Program
from tappet.lang.source import Source
from tappet.lang.symbols import PouSymbol

OPTIONS = BuildOptions(level=1)
TASKS = (TaskSpec("T", programs=("PLC_PRG",)),)

OBJECTS = {
    "G": "VAR_GLOBAL {G} total : DINT; log : STRING(40); calls : INT; END_VAR",
    "I_Shape": "INTERFACE I_Shape\nMETHOD Area : DINT\nEND_METHOD\nEND_INTERFACE",
    "Scale": "FUNCTION Scale : DINT\nVAR_INPUT n : DINT; END_VAR\n{Scale}\nEND_FUNCTION",
    "Bump": "FUNCTION Bump : DINT\nVAR_IN_OUT f : FB_Base; END_VAR\n{Bump}\nEND_FUNCTION",
    "Unused": "FUNCTION Unused : DINT\nVAR_INPUT n : DINT; END_VAR\n{Unused}\nEND_FUNCTION",
    "FB_Base": (
        "FUNCTION_BLOCK FB_Base IMPLEMENTS I_Shape\nVAR_INPUT n : DINT := 2; END_VAR\n"
        "VAR i : DINT; row : ARRAY [0..3] OF DINT; {Base_vars} END_VAR\n{FB_Base}\nEND_FUNCTION_BLOCK"
    ),
    "FB_Base.Area": "METHOD Area : DINT\n{FB_Base.Area}\nEND_METHOD",
    "FB_Base.Where": "METHOD Where : POINTER TO DINT\n{FB_Base.Where}\nEND_METHOD",
    "FB_Base.Act": "ACTION Act\n{FB_Base.Act}\nEND_ACTION",
    "FB_Derived": (
        "FUNCTION_BLOCK FB_Derived EXTENDS FB_Base\nVAR inner : FB_Leaf; END_VAR\n{FB_Derived}\n"
        "END_FUNCTION_BLOCK"
    ),
    "FB_Derived.Area": "METHOD Area : DINT\n{FB_Derived.Area}\nEND_METHOD",
    "FB_Leaf": (
        "FUNCTION_BLOCK FB_Leaf\nVAR_OUTPUT q : DINT; END_VAR\nVAR t : TON; END_VAR\n"
        "PROPERTY Value : DINT\nGET\n{FB_Leaf.get}\nEND_GET\nEND_PROPERTY\n{FB_Leaf}\nEND_FUNCTION_BLOCK"
    ),
    "PLC_PRG": (
        "PROGRAM PLC_PRG\nVAR\n    b : FB_Base; d : FB_Derived; leaf : FB_Leaf; s : I_Shape;\n"
        "    p : POINTER TO DINT; pb : POINTER TO FB_Base; i : INT; sum : DINT; text : STRING(30);\n"
        "    x AT %MW4 : INT;\nEND_VAR\n"
        "s := d; pb := ADR(b); p := b.Where();\n{PLC_PRG}\nEND_PROGRAM"
    ),
}
"""Texts with places for what is edited."""

BODIES = {
    "Scale": [
        "Scale := 3 * n;",
        "Scale := n - G.calls;",
        "G.calls := G.calls + 1;\n\nScale := n;",
        "Scale := nn;",
    ],
    "Bump": ["f.n := f.n + 1;", "f.Act(); Bump := f.Area();", "Bump := Scale(f.n);"],
    "Unused": ["", "Unused := Scale(n);", "Unused := missing;"],
    "FB_Base": [
        "FOR i := 0 TO 3 DO row[i] := row[i] + n; END_FOR",
        "// moved\n\nFOR i := 0 TO 3 DO n := n + 1; row[i] := THIS^.Area(); END_FOR",
        "G.total := G.total + n; Act();",
        "n := n / (i - i);",
    ],
    "FB_Base.Area": [
        "Area := n;",
        "Area := Scale(n) + i;",
        "FOR i := 0 TO 2 DO Area := Area + row[i]; END_FOR",
    ],
    "FB_Base.Where": ["Where := ADR(n);", "Where := ADR(G.total);", "Where := ADR(row[1]);"],
    "FB_Base.Act": ["n := n + 1;", "G.log := 'base acts'; n := -n;", ""],
    "FB_Derived": ["inner(); SUPER^();", "n := 7; inner();", "{warning 'derived'}\nSUPER^();"],
    "FB_Derived.Area": ["Area := SUPER^.Area() + 10;", "Area := 5;", "Area := inner.Value;"],
    "FB_Leaf": [
        "q := q + 2;",
        "t(IN := TRUE, PT := T#10MS); q := q + BOOL_TO_DINT(t.Q);",
        "q := LEN(G.log);",
    ],
    "FB_Leaf.get": ["Value := q;", "Value := q * 2 + MAX(q, 3);"],
    "PLC_PRG": [
        "b(); d(); leaf(); sum := sum + s.Area();",
        "b(); FOR i := 0 TO 4 DO b.n := b.n + 1; p^ := p^ + 10; END_FOR",
        "FOR i := 0 TO 4 DO b.n := b.n + 1; pb^.Act(); sum := sum + pb^.Area(); END_FOR",
        "text := CONCAT(text, 'ab');\nG.log := text; sum := Bump(b) + Bump(d); leaf();",
        "p := ADR(sum); FOR i := 0 TO 4 DO sum := sum + 1; p^ := p^ * 2; END_FOR x := x + i;",
        "text := DINT_TO_STRING(sum); sum := sum + Scale(i); s := b; sum := sum + s.Area(); i := i + 1;",
        "IF __QUERYINTERFACE(s, s) THEN sum := sum + 100; END_IF\n%MW5000 := 3;",
        "sum := 'text';",
        "\n\nleaf(); sum := leaf.Value + leaf.q; d();",
    ],
    "G": ["", "more : INT := 4;"],
    "Base_vars": ["", "extra : DINT := 3;"],
}


def sources(bodies: dict[str, str]) -> list[Source]:
    found = []
    for name, text in OBJECTS.items():
        for part, body in bodies.items():
            text = text.replace(f"{{{part}}}", body)
        owner, _, child = name.partition(".")
        named = name if name == "G" else None
        found.append(Source(name, text, name=named, owner=owner if child else None))
    return found


def first() -> dict[str, str]:
    return {name: choices[0] for name, choices in BODIES.items()}


@dataclass
class Pair:
    """One application, built after every edit in one session and as a whole."""

    bodies: dict[str, str] = field(default_factory=first)
    session: BuildSession = field(default_factory=BuildSession)
    other: BuildSession = field(default_factory=BuildSession)
    """Keeps nothing but library texts and objects."""

    def build(self, previous: CodePackage | None = None, tasks: tuple[TaskSpec, ...] = TASKS) -> BuildResult:
        return build_application(sources(self.bodies), tasks, OPTIONS, previous, self.session)

    def whole(self, previous: CodePackage | None = None, tasks: tuple[TaskSpec, ...] = TASKS) -> BuildResult:
        self.other.analysis = self.other.generated = None
        return build_application(sources(self.bodies), tasks, OPTIONS, previous, self.other)

    def both(self, previous: CodePackage | None = None) -> tuple[BuildResult, BuildResult]:
        return self.build(previous), self.whole(previous)


@pytest.fixture(autouse=True)
def small_modules(monkeypatch: pytest.MonkeyPatch) -> None:
    """The application is small: it would be one module."""
    monkeypatch.setattr(partition, "WHOLE", 0)
    monkeypatch.setattr(partition, "PART", 2)
    monkeypatch.setattr(partition, "SMALL", 5)


def messages(result: BuildResult) -> list[str]:
    return [str(d) for d in result.diagnostics]


def values(application: LoadedApplication, cycles: int = 3) -> list[object]:
    """What a number of cycles leave in the image; a fault ends them."""
    found: list[object] = []
    for _ in range(cycles):
        try:
            application.cycle()
        except ApplicationFault as fault:
            found.append((fault.code, fault.args_abc))
        application.clock_ns += 6_000_000
    names = ["PLC_PRG.sum", "PLC_PRG.text", "PLC_PRG.i", "PLC_PRG.x", "G.total", "G.log", "G.calls"]
    for block in ("PLC_PRG.b", "PLC_PRG.d"):
        names += [f"{block}.n", f"{block}.i", f"{block}.row"]
    names += ["PLC_PRG.leaf.q", "PLC_PRG.d.inner.q"]
    return found + [application.read(name) for name in names]


def lines(package: CodePackage) -> dict[str, set[int]]:
    """Lines with code, by text."""
    found: dict[str, set[int]] = {}
    for data in package.objects:
        for uri, line in _lines_of(data):
            found.setdefault(uri, set()).add(line)
    return found


def _lines_of(data: bytes) -> Iterator[tuple[str, int]]:
    dwarf = ELFFile(io.BytesIO(data)).get_dwarf_info()
    for unit in dwarf.iter_CUs():
        program = dwarf.line_program_for_CU(unit)
        names = [entry.name.decode() for entry in program["file_entry"]]
        for entry in program.get_entries():
            if entry.state is not None and not entry.state.end_sequence and entry.state.line:
                yield names[entry.state.file - 1], entry.state.line


edits = st.sampled_from(sorted(BODIES)).flatmap(
    lambda name: st.tuples(st.just(name), st.sampled_from(BODIES[name]))
)


@settings(max_examples=12, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.lists(st.tuples(st.lists(edits, min_size=1, max_size=2), st.booleans()), min_size=2, max_size=5))
def test_every_build_says_and_does_what_a_whole_one_does(steps: list[tuple[list[tuple[str, str]], bool]]):
    pair = Pair()
    loaded: CodePackage | None = None
    for changes, download in steps:
        pair.bodies |= dict(changes)
        after, whole = pair.both(loaded)
        assert messages(after) == messages(whole)
        assert after.ok == whole.ok
        if after.package is None or whole.package is None:
            continue
        assert after.package.data_id == whole.package.data_id
        assert after.package.code_id == whole.package.code_id
        with running(after.package) as a, running(whole.package) as b:
            assert values(a) == values(b)
        if loaded is not None:
            assert changed_over(loaded, after.package) == changed_over(loaded, whole.package)
        if download or loaded is None:
            loaded = after.package


def changed_over(old: CodePackage, new: CodePackage) -> list[object]:
    """Values after an online change in the third cycle."""
    with running(old) as application:
        values(application, 2)
        changed = change_over(application, new)
        try:
            return values(changed)
        finally:
            changed.close()


# -- single cases -----------------------------------------------------------------------------------


def agree(pair: Pair, partial: bool = True, previous: CodePackage | None = None) -> BuildResult:
    """The next build of a pair, which gives what a whole one gives."""
    after, whole = pair.both(previous)
    assert messages(after) == messages(whole)
    assert after.package is not None
    assert whole.package is not None
    assert after.partial == partial
    assert after.package.code_id == whole.package.code_id
    with running(after.package) as a, running(whole.package) as b:
        assert values(a) == values(b)
    return after


def edited(pair: Pair, **bodies: str) -> Pair:
    pair.bodies |= {name.replace("__", "."): body for name, body in bodies.items()}
    return pair


def test_edit_of_a_body_compiles_little():
    pair = Pair()
    whole = agree(pair, partial=False)
    assert whole.package is not None
    after = agree(edited(pair, FB_Leaf="q := q + 3;"))
    assert after.package is not None
    assert 2 <= after.cached_objects < len(after.package.objects)
    back = agree(edited(pair, FB_Leaf=BODIES["FB_Leaf"][0]))
    assert back.package is not None
    assert back.package.code_id == whole.package.code_id
    assert agree(edited(pair, G="more : INT;"), partial=False).cached_objects > 0


def test_edit_of_a_declaration_is_a_whole_build():
    pair = Pair()
    agree(pair, partial=False)
    agree(edited(pair, Base_vars="extra : DINT := 3;"), partial=False)
    agree(edited(pair, FB_Base="n := n + extra;"))


def test_changed_tasks_are_a_whole_build():
    pair = Pair()
    agree(pair, partial=False)
    tasks = (TaskSpec("T", programs=("PLC_PRG", "PLC_PRG")),)
    after, whole = pair.build(tasks=tasks), pair.whole(tasks=tasks)
    assert not after.partial
    assert after.package is not None
    assert whole.package is not None
    assert after.package.code_id == whole.package.code_id


def test_new_calls_reach_library_functions_constants_and_methods():
    pair = Pair()
    agree(pair, partial=False)
    agree(edited(pair, FB_Leaf="q := q + LEN(CONCAT('abc', 'de')) + REAL_TO_DINT(SQRT(16.0)); t();"))
    agree(edited(pair, PLC_PRG="sum := sum + Bump(b); text := DINT_TO_STRING(sum); G.log := 'a new text';"))
    agree(edited(pair, PLC_PRG="leaf(); sum := sum + leaf.Value;"))


def test_errors_in_between_leave_nothing_behind():
    pair = Pair()
    agree(pair, partial=False)
    for name, wrong in (("PLC_PRG", "sum := 'text';"), ("Scale", "Scale := nn;"), ("FB_Leaf", "q := ;")):
        after, whole = edited(pair, **{name: wrong}).both()
        assert not after.ok
        assert messages(after) == messages(whole)
    edited(pair, Scale="Scale := 5;", FB_Leaf="q := 8;", PLC_PRG="leaf(); sum := sum + Scale(1) + leaf.q;")
    agree(pair)


def test_lowering_that_fails_half_way_is_not_continued(monkeypatch: pytest.MonkeyPatch):
    pair = Pair()
    agree(pair, partial=False)
    edited(pair, FB_Leaf="q := 21;", FB_Base="n := 22;", PLC_PRG="b(); leaf(); sum := b.n + leaf.q;")
    count = 0

    def fails(program: Program, pou: PouSymbol) -> None:
        nonlocal count
        count += 1
        if count == 2:
            raise LoweringError("no code for this", "FB_Leaf", None)
        lower_pou(program, pou)

    with monkeypatch.context() as patch:
        patch.setattr("tappet.core.relower.lower_pou", fails)
        failed = pair.build()
    assert [d.code for d in failed.diagnostics if d.severity == "error"] == ["E0901"]
    agree(pair, partial=False)


def test_area_that_grows_is_a_whole_build():
    pair = Pair()
    agree(pair, partial=False)
    agree(edited(pair, PLC_PRG="%MW3000 := 7; sum := sum + %MW3000;"), partial=False)
    agree(edited(pair, PLC_PRG="%MW3001 := 7; sum := sum + %MW3001;"))


def test_online_change_after_edits():
    pair = Pair()
    first_build = agree(pair, partial=False).package
    assert first_build is not None
    second = agree(edited(pair, FB_Leaf="q := q + 100;"), previous=first_build).package
    assert second is not None
    assert second.online_change is not None
    assert (second.online_change.base_code_id, second.online_change.moves) == (first_build.code_id, ())
    assert second.data_id == first_build.data_id
    moved = agree(edited(pair, Base_vars="extra : DINT := 3;"), partial=False, previous=second).package
    assert moved is not None
    assert "tappet.online_change" not in second.exports
    edited(pair, FB_Leaf="q := q + 1000;")
    third = agree(pair, previous=moved).package
    assert third is not None
    assert third.online_change is not None
    assert third.online_change.base_code_id == moved.code_id
    assert changed_over(moved, third) == changed_over(moved, pair.whole(moved).package or moved)
    agree(edited(pair, FB_Leaf="q := q + 5;"), partial=False, previous=first_build)


def test_same_program_has_the_same_code_id_after_an_online_change_that_moved_data():
    pair = Pair()
    old = pair.build().package
    pair.bodies["Base_vars"] = "extra : POINTER TO DINT := ADR(n);"
    moved = pair.build(old).package
    assert moved is not None
    assert "tappet.online_change" in moved.exports
    again = pair.whole(moved).package
    assert again is not None
    assert "tappet.online_change" not in again.exports
    assert again.code_id == moved.code_id


def test_comments_are_no_change_of_the_code_but_lines_are():
    pair = Pair()
    old = agree(pair, partial=False).package
    assert old is not None
    commented = agree(edited(pair, FB_Leaf="q := q + 2; // ' two (*")).package
    moved = agree(edited(pair, FB_Leaf="\nq := q + 2;")).package
    text = agree(edited(pair, FB_Leaf="q := q + LEN('a//b') - 1;")).package
    other = agree(edited(pair, FB_Leaf="q := q + LEN('a//bc') - 1;")).package
    assert commented is not None
    assert commented.code_id == old.code_id
    assert len({p.code_id for p in (old, moved, text, other) if p is not None}) == 4


@pytest.mark.parametrize(
    ("name", "body"),
    [
        ("FB_Leaf", "\n\n{info 'note'}\n(* moved *)\nq := q + 2;"),
        ("Scale", "\n\n\nScale := 3 * n;\nScale := Scale + 1;"),
        ("PLC_PRG", "\nb();\n\nd(); leaf();\n\nsum := sum + s.Area();"),
        ("FB_Base.Area", "Area := n;\n\n\nArea := Scale(Area);"),
    ],
)
def test_lines_follow_the_edited_text(name: str, body: str):
    pair = Pair()
    pair.bodies["Scale"] = "\nScale := 3 * n;"
    pair.bodies["FB_Base.Area"] = "Area := Scale(n);"
    pair.build()
    pair.bodies[name] = body
    after, whole = pair.both()
    assert after.partial
    assert after.package is not None
    assert whole.package is not None
    assert lines(after.package) == lines(whole.package)


CHAIN = """
FUNCTION Pure : DINT
VAR_INPUT n : DINT; END_VAR
{pure}
END_FUNCTION
"""
VIRTUAL = """
FUNCTION_BLOCK FB_A
VAR k : DINT; END_VAR
METHOD M1 : DINT
M1 := 1;
END_METHOD
METHOD M2 : DINT
M2 := 20;
END_METHOD
END_FUNCTION_BLOCK
FUNCTION_BLOCK FB_B EXTENDS FB_A
METHOD M1 : DINT
M1 := 300;
END_METHOD
METHOD M2 : DINT
M2 := 4000;
END_METHOD
END_FUNCTION_BLOCK
PROGRAM PLC_PRG
VAR_INPUT sum : DINT; END_VAR
VAR a : FB_A; b : FB_B; p : POINTER TO FB_A; i : DINT; END_VAR
p := ADR(b);
sum := p^.M1() + p^.M2();
FOR i := 0 TO 9 DO sum := sum + Pure(i); END_FOR
END_PROGRAM
"""


def run_of(session: BuildSession, texts: dict[str, str], *paths: str, partial: bool) -> list[object]:
    built = build_application([Source(n, text) for n, text in texts.items()], (), OPTIONS, None, session)
    assert messages(built) == [m for m in messages(built) if "error" not in m]
    assert built.package is not None
    assert built.partial == partial
    with running(built.package) as application:
        application.cycle()
        return [application.read(path) for path in paths]


def test_functions_that_rested_on_an_edited_one_keep_their_virtual_calls():
    """PLC_PRG keeps `sum` in a register while it calls Pure; that ends when Pure reads `sum`."""
    session = BuildSession()
    texts = {"Pure": CHAIN.format(pure="Pure := n;"), "Rest": VIRTUAL}
    assert run_of(session, texts, "PLC_PRG.sum", partial=False) == [4300 + 45]
    texts["Pure"] = CHAIN.format(pure="PLC_PRG.sum := PLC_PRG.sum + 1; Pure := n;")
    (changed,) = run_of(session, texts, "PLC_PRG.sum", partial=True)
    assert [changed] == run_of(BuildSession(), texts, "PLC_PRG.sum", partial=False)
    assert isinstance(changed, int)
    assert changed > 4300


BASE = """
FUNCTION_BLOCK FB_Base
VAR_INPUT n : DINT; END_VAR
VAR i : DINT; END_VAR
METHOD Loop
VAR_INPUT p : POINTER TO DINT; END_VAR
FOR i := 0 TO 9 DO n := n + 1; p^ := 100 + i; END_FOR
END_METHOD
END_FUNCTION_BLOCK
PROGRAM PLC_PRG
VAR d : FB_Derived; other : DINT; END_VAR
d.Loop(d.Where());
END_PROGRAM
"""
DERIVED = """
FUNCTION_BLOCK FB_Derived EXTENDS FB_Base
METHOD Where : POINTER TO DINT
{where}
END_METHOD
END_FUNCTION_BLOCK
"""


def test_address_taken_in_a_derived_block_reaches_the_base():
    session = BuildSession()
    texts = {"Base": BASE, "Derived": DERIVED.format(where="Where := ADR(PLC_PRG.other);")}
    assert run_of(session, texts, "PLC_PRG.d.n", partial=False) == [10]
    texts["Derived"] = DERIVED.format(where="Where := ADR(n);")
    assert run_of(session, texts, "PLC_PRG.d.n", partial=True) == [109]


DYNAMIC = """
INTERFACE I_Thing
METHOD Name : DINT
END_METHOD
END_INTERFACE
FUNCTION_BLOCK FB_One IMPLEMENTS I_Thing
METHOD Name : DINT
Name := 1;
END_METHOD
END_FUNCTION_BLOCK
{attribute 'enable_dynamic_creation'}
FUNCTION_BLOCK FB_Two IMPLEMENTS I_Thing
METHOD Name : DINT
Name := 2;
END_METHOD
END_FUNCTION_BLOCK
"""
USER = """
PROGRAM PLC_PRG
VAR one : FB_One; p : POINTER TO FB_Two; thing : I_Thing; sum : DINT; END_VAR
thing := one;
%s
sum := thing.Name();
END_PROGRAM
"""


def test_block_type_known_from_the_running_application_gets_its_methods():
    texts = {"Things": DYNAMIC, "PLC_PRG": USER % "p := __NEW(FB_Two); thing := p^;"}

    def build(session: BuildSession, previous: CodePackage | None) -> BuildResult:
        return build_application([Source(n, x) for n, x in texts.items()], (), OPTIONS, previous, session)

    old = build(BuildSession(), None).package
    assert old is not None
    new_texts = dict(texts)
    texts["PLC_PRG"] = USER % ""
    session = BuildSession()
    without = build(session, old).package
    assert without is not None
    texts = new_texts
    after = build(session, without)
    assert after.partial
    assert after.package is not None
    with running(after.package) as application:
        application.cycle()
        assert application.read("PLC_PRG.sum") == 2


def test_configured_addresses_are_not_repeated():
    texts = {
        "Config": "VAR_CONFIG PLC_PRG.x AT %IW4 : INT; END_VAR",
        "PLC_PRG": "PROGRAM PLC_PRG\nVAR x AT %I* : INT; y : INT; END_VAR\ny := x;\nEND_PROGRAM",
    }
    session = BuildSession()
    for body in ("y := x;", "y := x + 1;", "y := x + 2;"):
        texts["PLC_PRG"] = f"PROGRAM PLC_PRG\nVAR x AT %I* : INT; y : INT; END_VAR\n{body}\nEND_PROGRAM"
        built = build_application([Source(n, x) for n, x in texts.items()], (), OPTIONS, None, session)
        assert built.package is not None
        assert built.analysis is not None
        count = len(built.analysis.configured)
        assert count == 1
