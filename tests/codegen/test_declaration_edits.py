"""Builds after edits of declarations give what a whole build gives, and lower no more than they must."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from contextlib import contextmanager

import core_text
import pytest
from edited_application import changed_over, faults
from edited_declarations import CHOICES, EDITS, OPTIONS, VALUES, build
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from linked_application import LoadedApplication, loaded

from tappet.codegen import compile_pool
from tappet.codegen.build import BuildSession, build_application
from tappet.codegen.generate import Generated
from tappet.codegen.package import CodePackage
from tappet.codegen.symbol_map import SymbolMap
from tappet.core.lower import lower_pou
from tappet.core.program import Program
from tappet.lang.source import Source
from tappet.lang.symbols import PouSymbol


class _NoMachineCode:
    """Stands for the compiler where only what it is given matters."""

    def __init__(self, *given: object) -> None:
        self.keys: list[str] = []

    def add(self, text: str) -> str:
        self.keys.append(str(hash(text)))
        return self.keys[-1]

    def objects(self) -> list[bytes]:
        return [key.encode() for key in self.keys]


@pytest.fixture
def no_machine_code(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(compile_pool, "Compilation", lambda *given, **options: _NoMachineCode())


# -- the same as a build of everything --------------------------------------------------------------


def leaves(symbols: SymbolMap) -> Iterator[tuple[object, ...]]:
    """Every variable with its place and type, by path."""
    todo = [(root.name, root.type, root.offset) for root in symbols.roots.values()]
    while todo:
        path, number, offset = todo.pop()
        info = symbols.types[number]
        yield path, offset, info.name, info.kind, info.size, info.bounds, info.values, info.length
        for member in info.members:
            start = 0 if member.absolute else offset
            yield path, member.name, member.section, member.flags, member.bit, member.absolute
            todo.append((f"{path}.{member.name}", member.type, start + member.offset))
        if info.kind == "array" and info.elem is not None:
            todo.append((f"{path}[]", info.elem, offset))


_COMPARED = (
    "data_id", "code_id", "image_size", "data_objects", "initial_image", "tasks", "retain", "persistent",
    "no_init", "type_ids", "online_change", "facts",
)  # fmt: skip


def differences(found: Generated, whole: Generated) -> list[str]:
    """What two generations disagree about, in short."""
    result: list[str] = []

    def compare(what: str, one: object, other: object) -> None:
        if one != other:
            result.append(f"{what}: {str(one)[:300]} instead of {str(other)[:300]}")

    code, other = core_text.functions(found.lowered.module), core_text.functions(whole.lowered.module)
    for name in sorted(code.keys() | other.keys()):
        lines = [functions.get(name, "").split("\n") for functions in (code, other)]
        for one, two in itertools.zip_longest(*lines):
            compare(name, one, two)
    for name in _COMPARED:
        compare(name, getattr(found.package, name), getattr(whole.package, name))
    compare("exports", sorted(found.package.exports), sorted(whole.package.exports))
    known, expected = (sorted(map(repr, leaves(g.package.symbols))) for g in (found, whole))
    for one, two in itertools.zip_longest(known, expected):
        compare("symbols", one, two)
    return result[:5]


edits = st.lists(st.sampled_from(EDITS), min_size=1, max_size=2)
steps = st.lists(st.tuples(edits, st.booleans()), min_size=4, max_size=8)


@pytest.mark.usefixtures("no_machine_code")
@settings(
    max_examples=12,
    deadline=None,
    derandomize=True,
    suppress_health_check=[HealthCheck.function_scoped_fixture],
)
@given(edits, steps)
def test_every_edit_gives_the_code_data_and_symbols_of_a_whole_build(
    begin: list[tuple[str, int]], steps: list[tuple[list[tuple[str, int]], bool]]
) -> None:
    chosen, session, other = dict(begin), BuildSession(), BuildSession()
    running = build(chosen, session).package  # a new build takes the numbers of its block types
    for edit, download in steps:
        chosen |= dict(edit)
        after = build(chosen, session, running)
        other.analysis = other.generated = None
        whole = build(chosen, other, running)
        assert [str(d) for d in after.diagnostics] == [str(d) for d in whole.diagnostics]
        assert after.package is not None
        assert session.generated is not None
        assert other.generated is not None
        assert after.partial
        assert differences(session.generated, other.generated) == []
        if download:
            running = after.package


# -- what runs --------------------------------------------------------------------------------------


def values(application: LoadedApplication, cycles: int = 3) -> list[object]:
    return faults(application, cycles) + [application.read(name) for name in VALUES]


@pytest.mark.usefixtures("small_modules")
@pytest.mark.parametrize(
    "edit",
    [
        {"core": 2},
        {"core": 1, "fresh": 2},
        {"core_in": 2},
        {"point": 1, "point_x": 2},
        {"gvl": 2},
        {"limits": 1, "gain": 1},
        {"enum": 1, "enum_base": 2},
        {"area_in": 2},
        {"sum_in": 2, "sum_b": 2},
        {"retain": 1, "second": 2},
        {"made": 2, "first": 1, "square": 1},
        {"prg": 2, "shape": 2},
    ],
    ids=str,
)
def test_the_application_runs_and_changes_over_as_one_built_whole(edit: dict[str, int]) -> None:
    session = BuildSession()
    old = build({}, session).package
    assert old is not None
    after, whole = build(edit, session, old), build(edit, BuildSession(), old)
    assert after.partial
    assert after.package is not None
    assert whole.package is not None
    with loaded(after.package) as a, loaded(whole.package) as b:
        a.start()
        b.start()
        assert values(a) == values(b)
    assert changed_over(old, after.package, values) == changed_over(old, whole.package, values)
    back = build({}, session, after.package)
    assert back.partial
    assert back.package is not None
    with loaded(back.package) as a, loaded(old) as b:
        assert values(a) == values(b)


# -- no more than it must ---------------------------------------------------------------------------


@contextmanager
def lowered_bodies(monkeypatch: pytest.MonkeyPatch) -> Iterator[list[str]]:
    """Names of the bodies that are lowered in the meantime."""
    found: list[str] = []

    def note(program: Program, pou: PouSymbol) -> None:
        found.append(program.functions[id(pou)])
        lower_pou(program, pou)

    with monkeypatch.context() as patch:
        patch.setattr("tappet.core.edits.relower.lower_pou", note)
        yield found


@pytest.mark.usefixtures("no_machine_code")
@pytest.mark.parametrize(
    ("edit", "looked_at"),
    [
        ({"gvl": 1}, {"FB_Made.FB_Init", "FB_Shape", "FB_Shape.Move", "PLC_PRG", "P_Second"}),
        ({"retain": 1}, {"P_Second"}),
        ({"second": 1}, {"P_Second"}),
        ({"gain": 1}, {"PLC_PRG"}),
        (
            {"core": 2},
            {"FB_Core", "FB_Shape", "FB_Shape.Move", "FB_Square", "FB_Square.Area", "PLC_PRG", "P_Second"},
        ),
        ({"sum_b": 1}, {"F_Sum", "PLC_PRG"}),
        ({"square": 1}, {"FB_Square", "FB_Square.Area", "PLC_PRG"}),
        ({"shape": 1}, {"FB_Shape", "FB_Shape.Area", "FB_Square", "PLC_PRG"}),
        ({"by": 1}, {"FB_Shape.Move", "PLC_PRG"}),
    ],
    ids=lambda value: str(value) if isinstance(value, dict) else "",
)
def test_bodies_that_can_tell_no_difference_stay(
    edit: dict[str, int], looked_at: set[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    session = BuildSession()
    build({}, session)
    with lowered_bodies(monkeypatch) as found:
        after = build(edit, session)
    assert after.partial
    assert sorted(set(found)) == sorted(looked_at)
    assert len(found) == len(looked_at)


@pytest.mark.usefixtures("small_modules")
def test_a_list_that_grows_behind_its_variables_leaves_all_code_as_it_is() -> None:
    session = BuildSession()
    first = build({}, session)
    after = build({"retain": 1}, session)
    assert first.package is not None
    assert after.package is not None
    assert after.cached_objects >= len(first.package.objects) - 2


def counts(session: BuildSession) -> list[int]:
    """Sizes of what a session keeps."""
    generated = session.generated
    assert generated is not None
    program = generated.lowered.program
    assert program is not None
    dependencies = generated.settle()
    cached = sum(len(cache.memory) for cache in session.objects.values())
    return [
        cached, len(dependencies.dependencies), len(dependencies.keys), len(program.strings),
        len(program.module.constants),
        len(program.module.functions), len(program.homes), len(program.taken), len(program.holding),
        len(generated.parts), len(generated.laid.types.known), len(program.functions),
    ]  # fmt: skip


@pytest.mark.usefixtures("no_machine_code")
def test_what_a_session_keeps_does_not_grow() -> None:
    session = BuildSession()
    rounds = []
    for _ in range(3):
        running = build({}, session).package
        for place in CHOICES:
            result = build({place: 1}, session, running)
            assert result.package is not None
        result = build({}, session, running)
        assert result.package is not None
        rounds.append(counts(session))
        generated = session.generated
        assert generated is not None
        table = generated.laid.table
        assert len(table.types) <= table.limit + len(table.types) // 2
    assert rounds[1] == rounds[2]


WATCHED = """FUNCTION_BLOCK FB
VAR {lead}n : DINT; END_VAR
{{attribute 'monitoring' := 'call'}}
PROPERTY Twice : DINT
GET
Twice := n * 2;
END_GET
END_PROPERTY
n := n + 1;
END_FUNCTION_BLOCK
PROGRAM PLC_PRG VAR a : FB; b : ARRAY [0..3] OF FB; END_VAR
a(); b[1]();
END_PROGRAM
"""


@pytest.mark.usefixtures("no_machine_code")
def test_functions_made_for_a_block_follow_its_layout() -> None:
    session = BuildSession()
    running: CodePackage | None = None
    for lead in ("", "lead : LREAL; ", "lead : STRING(30); ", ""):
        texts, other = [Source("FB", WATCHED.format(lead=lead))], BuildSession()
        after = build_application(texts, (), OPTIONS, running, session)
        build_application(texts, (), OPTIONS, running, other)
        assert session.generated is not None
        assert other.generated is not None
        assert after.partial == (running is not None)
        assert differences(session.generated, other.generated) == []
        running = running or after.package
