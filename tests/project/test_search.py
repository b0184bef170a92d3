"""Finding and replacing in projects."""

from __future__ import annotations

import json
import re
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.project.project_paths import APP, at

from tappet.iec.languages import languages
from tappet.iec.languages.language import Language
from tappet.project import edit
from tappet.project.errors import InvalidNameError, UnknownObjectError
from tappet.project.model import Project, ProjectObject
from tappet.project.new_project import new_project
from tappet.project.objects import changed_object, make_object
from tappet.project.search.finding import Findings, find_in_project
from tappet.project.search.pattern import Pattern, replacement
from tappet.project.search.query import Area, InvalidPatternError, InvalidReplacementError, Query
from tappet.project.search.replacing import NotReplaceableError, replace_in_project

PROGRAM = f"{APP}/PLC_PRG"


def project_with(declaration: str, implementation: str, **data: Any) -> tuple[Project, ProjectObject]:
    project = new_project("x")
    item = at(project, PROGRAM)
    fields = item.data.model_dump() | {"declaration": declaration, "implementation": implementation} | data
    changed = changed_object(item, data=fields)
    return Project("x", "", {**project.objects, item.id: changed}), changed


def found(project: Project, query: Query, **options: Any) -> list[str]:
    """Each hit as area, line, column and the line it stands in."""
    return [
        f"{hit.area} {hit.line}:{hit.column} {hit.before}[{hit.match}]{hit.after}"
        for group in find_in_project(project, query, **options).objects
        for hit in group.hits
    ]


def replaced(project: Project, query: Query, text: str, *left_out: int) -> Project:
    pattern = Pattern(query)
    chosen = {
        group.item.id: [hit.number for hit in group.hits if hit.number not in left_out]
        for group in find_in_project(project, query).objects
    }
    return replace_in_project(project, query, pattern, replacement(pattern, text), chosen)[0]


def test_a_hit_has_its_line_and_area() -> None:
    project, _ = project_with(
        "PROGRAM PLC_PRG\nVAR\n    Speed : INT; // speed in mm/s\nEND_VAR",
        "Speed := Speed + 1; (* SPEED *)",
    )
    assert found(project, Query("speed")) == [
        "declarations 3:5 [Speed] : INT; // speed in mm/s",
        "comments 3:21 Speed : INT; // [speed] in mm/s",
        "implementations 1:1 [Speed] := Speed + 1; (* SPEED *)",
        "implementations 1:10 Speed := [Speed] + 1; (* SPEED *)",
        "comments 1:24 Speed := Speed + 1; (* [SPEED] *)",
    ]
    for area in Area:
        query = Query("speed", areas=frozenset([area]))
        assert {line.split()[0] for line in found(project, query)} <= {area.value}


def test_case_and_whole_words() -> None:
    project, _ = project_with("PROGRAM PLC_PRG\nVAR\nEND_VAR", "Run := nRun OR run OR Run_1 OR Run;")
    code = frozenset([Area.IMPLEMENTATIONS])
    assert len(found(project, Query("run", areas=code))) == 5
    assert len(found(project, Query("Run", match_case=True, areas=code))) == 4
    assert len(found(project, Query("run", whole_words=True, areas=code))) == 3
    assert len(found(project, Query("Run", match_case=True, whole_words=True, areas=code))) == 2


def test_whole_words_know_letters_of_all_languages() -> None:
    project, _ = project_with("PROGRAM PLC_PRG\nVAR\nEND_VAR", "Länge := Längenmaß + Maß + 长度;")
    code = frozenset([Area.IMPLEMENTATIONS])
    assert found(project, Query("maß", whole_words=True, areas=code)) == [
        "implementations 1:22 Länge := Längenmaß + [Maß] + 长度;"
    ]
    assert len(found(project, Query("长度", whole_words=True, areas=code))) == 1


def test_names_and_tables() -> None:
    project = new_project("x")
    tasks = frozenset([Area.NAMES, Area.TABLES])
    lines = found(project, Query("PLC_PRG", areas=tasks))
    assert lines == ["names 1:1 [PLC_PRG]", "tables 1:1 [PLC_PRG]"]
    (task,) = (
        group for group in find_in_project(project, Query("T#20ms")).objects if group.item.kind == "task"
    )
    assert task.hits[0].content.path == ("interval",)


def test_regular_expressions_over_lines() -> None:
    project, _ = project_with("PROGRAM PLC_PRG\nVAR\nEND_VAR", "IF a THEN\n    b := 1;\nEND_IF")
    code = frozenset([Area.IMPLEMENTATIONS])
    query = Query(r"THEN\s+(\w+) :=", regular_expression=True, areas=code)
    (hit,) = find_in_project(project, query).objects[0].hits
    assert (hit.line, hit.column, hit.end_line, hit.end_column) == (1, 6, 2, 9)
    assert hit.found.groups == ("THEN\n    b :=", "b")
    assert len(found(project, Query(r"^\s*\w+", regular_expression=True, areas=code))) == 3


@pytest.mark.parametrize("text", ["(a", "a**", "[", r"\2", "(?=a)", "(?<!b)c", "a{9999}", ""])
def test_what_is_no_pattern_is_refused(text: str) -> None:
    with pytest.raises(InvalidPatternError):
        Pattern(Query(text, regular_expression=True))


def test_look_around_is_refused_by_name() -> None:
    with pytest.raises(InvalidPatternError, match="look-around and back references cannot be searched for"):
        Pattern(Query("(?=a)b", regular_expression=True))
    with pytest.raises(InvalidPatternError, match="at most 1000 characters"):
        Pattern(Query("x" * 1001))


@pytest.mark.parametrize("text", ["(x+x+)+y", "(x*)*y", "(x|x)*y", "(x|xx)+y"])
def test_a_pattern_that_backtracks_ends(text: str) -> None:
    """With `re`, forty characters of this take longer than the universe has time."""
    assert list(Pattern(Query(text, regular_expression=True)).matches("x" * 100_000)) == []


def test_a_search_ends_at_its_limit_and_goes_on() -> None:
    project = new_project("x")
    application = at(project, APP)
    for number in range(6):
        project, _ = edit.add_object(project, application.id, "gvl", f"Vars{number}")
    query = Query("VAR_GLOBAL", areas=frozenset([Area.DECLARATIONS]))
    everything = [group.item.name for group in find_in_project(project, query).objects]
    assert everything == [f"Vars{number}" for number in range(6)]
    pages: list[Findings] = []
    after: str | None = None
    while not pages or after is not None:
        pages.append(find_in_project(project, query, limit=2, after=after))
        after = pages[-1].next
    assert [group.item.name for page in pages for group in page.objects] == everything
    assert all(sum(len(group.hits) for group in page.objects) <= 2 for page in pages)
    cut, _ = project_with("PROGRAM PLC_PRG\nVAR\nEND_VAR", "x;" * 10)
    (group,) = find_in_project(cut, Query("x;"), limit=3).objects
    assert (len(group.hits), group.total) == (3, 10)


def test_only_chosen_objects_are_searched() -> None:
    project = new_project("x")
    application, program = at(project, APP), at(project, PROGRAM)
    query = Query("PLC_PRG")
    everything = find_in_project(project, query)
    below = find_in_project(project, query, within=[application.id])
    alone = find_in_project(project, query, within=[application.id], children=False)
    one = find_in_project(project, query, within=[program.id])
    assert [group.item.name for group in one.objects] == ["PLC_PRG"]
    assert len(everything.objects) == len(below.objects) == 2
    assert (alone.objects, alone.searched) == ((), 1)
    with pytest.raises(UnknownObjectError):
        find_in_project(project, query, within=["0" * 32])


def test_drawn_bodies_are_searched_by_element(monkeypatch: pytest.MonkeyPatch) -> None:
    drawn_language = Language("DRAWN", "Drawn", "m:READER", extension="drawn", text=False)
    monkeypatch.setitem(languages(), "DRAWN", drawn_language)
    body = json.dumps({"networks": [{"id": "n1", "in": "Speed", "items": [{"id": "e2", "text": "speed*2"}]}]})
    project, item = project_with("PROGRAM PLC_PRG\nVAR\nEND_VAR", body, language="DRAWN")
    query = Query("speed", areas=frozenset([Area.IMPLEMENTATIONS]))
    hits = find_in_project(project, query).objects[0].hits
    assert [(hit.content.element, hit.match, hit.line) for hit in hits] == [
        ("n1", "Speed", 1),
        ("e2", "speed", 1),
    ]
    done = replaced(project, query, 'r"pm')
    drawn = json.loads(done.get(item.id).data.model_dump()["implementation"])
    assert drawn == {"networks": [{"id": "n1", "in": 'r"pm', "items": [{"id": "e2", "text": 'r"pm*2'}]}]}


def test_only_chosen_hits_are_replaced() -> None:
    project, item = project_with("PROGRAM PLC_PRG\nVAR\n a : INT;\nEND_VAR", "a := a + 1; // a")
    query = Query("a", whole_words=True)
    data = replaced(project, query, "bb", 1).get(item.id).data.model_dump()
    assert data["declaration"] == "PROGRAM PLC_PRG\nVAR\n bb : INT;\nEND_VAR"
    assert data["implementation"] == "a := bb + 1; // bb"


def test_a_name_is_replaced_with_what_follows_it() -> None:
    project = replaced(new_project("x"), Query("PLC_PRG", areas=frozenset([Area.NAMES])), "Main")
    program = at(project, f"{APP}/Main")
    assert program.data.model_dump()["declaration"].startswith("PROGRAM Main")
    (task,) = project.find_kind("task")
    assert task.data.model_dump()["pous"][0]["name"] == "Main"
    with pytest.raises(InvalidNameError):
        replaced(new_project("x"), Query("PLC_PRG", areas=frozenset([Area.NAMES])), "no name")


def test_names_headers_and_calls_are_replaced_together() -> None:
    project = replaced(new_project("x"), Query("PLC_PRG"), "Main")
    assert found(project, Query("PLC_PRG")) == []
    assert at(project, f"{APP}/Main").data.model_dump()["declaration"].startswith("PROGRAM Main")


def test_numbers_and_fixed_names_are_found_and_stay() -> None:
    project = new_project("x")
    task = project.find_kind("task")[0]
    priority = task.data.model_dump()["priority"]
    query = Query(str(priority), whole_words=True, areas=frozenset([Area.TABLES]))
    (group,) = (group for group in find_in_project(project, query).objects if group.item.id == task.id)
    assert [hit.content.writable for hit in group.hits if hit.content.path == ("priority",)] == [False]
    with pytest.raises(NotReplaceableError, match="is a number or a fixed name; leave it out"):
        replaced(project, query, "7")
    pattern = Pattern(query)
    with pytest.raises(NotReplaceableError, match="search again"):
        replace_in_project(project, query, pattern, replacement(pattern, ""), {task.id: [99]})


@pytest.mark.parametrize(
    ("replace", "becomes"),
    [("$2-$1", "b-a"), ("$0!", "ab!"), ("$&$$", "ab$"), ("${1}0", "a0"), (r"\n\t\\", "\n\t\\"), ("$x", "$x")],
)
def test_groups_in_what_replaces(replace: str, becomes: str) -> None:
    pattern = Pattern(Query("(a)(b)", regular_expression=True))
    (match,) = pattern.matches("ab")
    assert replacement(pattern, replace)(match) == becomes
    plain = Pattern(Query("ab"))
    assert replacement(plain, replace)(next(plain.matches("ab"))) == replace


def test_a_group_that_is_not_there_is_refused() -> None:
    pattern = Pattern(Query("(a)", regular_expression=True))
    with pytest.raises(InvalidReplacementError, match="group 2, but the regular expression has 1 group"):
        replacement(pattern, "$2")


@settings(max_examples=150)
@given(
    text=st.text(alphabet="aAbé长😀_ \n(*)/'", max_size=60),
    wanted=st.sampled_from(["a", "é", "长", "😀", "b\n"]),
)
def test_offsets_are_those_of_the_text(text: str, wanted: str) -> None:
    """Against `re`, which has the same meaning for plain texts."""
    expected = [match.span() for match in re.finditer(re.escape(wanted), text)]
    matches = list(Pattern(Query(wanted, match_case=True)).matches(text))
    assert [(match.start, match.end) for match in matches] == expected
    item = make_object(id="0" * 32, kind="gvl", name="G", data={"declaration": text})
    query = Query(wanted, match_case=True, areas=frozenset([Area.DECLARATIONS, Area.COMMENTS]))
    hits = [
        hit
        for group in find_in_project(Project("x", "", {item.id: item}), query).objects
        for hit in group.hits
    ]
    lines = text.split("\n")
    for hit, (start, end) in zip(hits, expected, strict=True):
        assert sum(len(line) + 1 for line in lines[: hit.line - 1]) + hit.column - 1 == start
        assert sum(len(line) + 1 for line in lines[: hit.end_line - 1]) + hit.end_column - 1 == end
        assert hit.match == wanted
