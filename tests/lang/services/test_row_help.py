"""Help while rows of IL are written: proposals, colours, networks, columns."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st
from marked_texts import Project

from tappet.lang.lexer import tokenize
from tappet.lang.services.completion import complete, proposals
from tappet.lang.services.documents import Position
from tappet.lang.services.folding import folds
from tappet.lang.services.formatting import format_text
from tappet.lang.services.hover import hover
from tappet.lang.services.navigation import references
from tappet.lang.services.operands import OperandFacts, facts
from tappet.lang.services.results import ServiceError
from tappet.lang.services.semantic_tokens import semantic_tokens
from tappet.lang.source import Source

HEAD = """PROGRAM PLC_PRG
VAR
    iCount, iTotal : INT;
    xStart : BOOL;
END_VAR
"""


def project(body: str) -> Project:
    return Project(PLC_PRG=f"{HEAD}{body}\nEND_PROGRAM")


def labels(body: str) -> list[str]:
    p = project(body)
    return [item.label for item in complete(p.workspace, p.document, p.position)]


def test_operators_are_proposed_at_the_beginning_of_a_row() -> None:
    """IL-01: the operator column holds operators, functions, instances."""
    found = labels("LD iCount\n|\nST iTotal")
    assert {"LD", "LDN", "ST"} <= set(found[:6])
    assert {"ADD", "CALC", "JMPCN", "iCount", "SEL"} <= set(found)
    assert not {"IF", "VAR", "END_IF"} & set(found)


def test_operands_and_labels_are_proposed_behind_it() -> None:
    found = labels("LD |iCount\nST iTotal")
    assert {"iCount", "xStart", "TRUE"} <= set(found)
    assert "LDN" not in found
    assert labels(
        "LD xStart\nJMPC |\nLD iCount\nST iTotal\nfar:\nLD 1\nST iCount\nnear: LD 2\nST iCount"
    ) == ["far", "near"]


def test_operators_are_coloured_as_keywords() -> None:
    p = project("|loop: LD iCount\nADD 1\nST iCount\nLT 10\nJMPC loop")
    tokens = semantic_tokens(p.snapshot, p.document)
    text = p.objects["PLC_PRG"].split("\n")
    keywords = [
        text[t.line][t.column : t.column + t.length] for t in tokens if t.type == "keyword" and t.line > 4
    ]
    assert keywords == ["LD", "ADD", "ST", "LT", "JMPC", "END_PROGRAM"]
    assert [t.type for t in tokens if text[t.line][t.column : t.column + t.length] == "loop"] == [
        "label",
        "label",
    ]


def test_networks_fold() -> None:
    """NET-06: a label begins a network."""
    p = project("|LD 1\nST iCount\na:\nLD 2\nST iCount\nb:\nLD 3\nST iCount")
    found = [(fold.start, fold.end) for fold in folds(p.snapshot, p.document)]
    assert (7, 9) in found
    assert (10, 12) in found


def test_a_body_without_labels_has_no_networks() -> None:
    p = project("|LD 1\nST iCount")
    assert [(fold.start, fold.end) for fold in folds(p.snapshot, p.document)] == [(0, 7), (1, 4)]


def test_hover_and_references_find_operands() -> None:
    p = project("LD iCo|unt\nADD iCount\nST iTotal\nST iCount")
    shown = hover(p.snapshot, p.document, p.position)
    assert shown is not None
    assert "INT" in shown.code
    found = references(p.snapshot, p.document, p.position)
    assert sorted(item.place.span.line for item in found) == [2, 5, 6, 8]


UGLY = """ld   iCount (* load *)
 add( 1
mul iTotal,2
)
st iTotal
// a comment

loop: ldn xStart
jmpc loop
cal t1( IN:=xStart,
PT:=T#1s)
verylonglabel: SEL 1, 2"""


def test_columns_are_aligned() -> None:
    assert format_text(UGLY).split("\n") == [
        "        LD      iCount (* load *)",
        "        ADD(    1",
        "          MUL     iTotal,2",
        "        )",
        "        ST      iTotal",
        "// a comment",
        "",
        "loop:   LDN     xStart",
        "        JMPC    loop",
        "        CAL     t1( IN:=xStart,",
        "                PT:=T#1s)",
        "verylonglabel: SEL     1, 2",
    ]
    assert format_text(format_text(UGLY)) == format_text(UGLY)


_WORDS = "LD ST iCount l: ( ) , := 1 (*c*) CAL t1( 'a' * (* x"


@given(st.lists(st.sampled_from([*_WORDS.split(), "//d\n", "\n", "\n"]), max_size=25))
def test_columns_change_nothing_else(words: list[str]) -> None:
    text = "LD iCount\n" + " ".join(words)
    before = [(t.kind, t.text.upper()) for t in tokenize(Source("a", text))]
    after = [(t.kind, t.text.upper()) for t in tokenize(Source("a", format_text(text)))]
    assert after == before


CHART = """PROGRAM PLC_PRG
VAR lamp : BOOL; END_VAR
INITIAL_STEP S: lamp(N); END_STEP
STEP |T: END_STEP
TRANSITION FROM S TO T := S.t > T#1s; END_TRANSITION
TRANSITION FROM T TO S := NOT T.x; END_TRANSITION
END_PROGRAM"""


def test_steps_of_a_chart_are_found_where_they_are_written() -> None:
    """What a chart becomes stands in no text: only written names are found, each once."""
    p = Project(PLC_PRG=CHART)
    found = references(p.snapshot, p.document, p.position)
    assert [item.place.span[:2] for item in found] == [(3, 5), (4, 21), (5, 16), (5, 30)]
    assert all(t.column >= 0 for t in semantic_tokens(p.snapshot, p.document))


def test_flags_of_a_step_are_proposed() -> None:
    """LSFC-50, LSFC-53."""
    p = Project(PLC_PRG=CHART.replace("|", "").replace("S.t > T#1s", "S.|"))
    assert {item.label for item in complete(p.workspace, p.document, p.position)} >= {"x", "t"}
    assert "Clear" not in {item.label for item in complete(p.workspace, p.document, p.position)}


def test_actions_are_found_at_every_step() -> None:
    body = (
        CHART.replace("|", "")
        .replace("STEP T:", "STEP T: lamp(N); Act(P);")
        .replace("S: lamp", "S: Act(N); |lamp")
    )
    body = body.replace("END_PROGRAM", "ACTION Act: lamp := lamp; END_ACTION\nEND_PROGRAM")
    p = Project(PLC_PRG=body)
    found = sorted({item.place.span.line for item in references(p.snapshot, p.document, p.position)})
    assert found == [1, 2, 3, 6]
    p = Project(PLC_PRG=body.replace("|", "").replace("ACTION Act", "ACTION |Act"))
    assert [item.place.span.line for item in references(p.snapshot, p.document, p.position)] == [2, 3, 6]


def facts_of(*wanted: str) -> list[OperandFacts | None]:
    body = HEAD.replace(
        "END_VAR", "fbDelay : TON; (* Start delay *)\nxSwitch AT %IX0.3 : BOOL; // Main switch\nEND_VAR"
    )
    p = Project(
        PLC_PRG=f"{body}|LD iCount\nST iTotal\nEND_PROGRAM",
        GVL="VAR_GLOBAL\n gLimit : REAL; // Upper\nEND_VAR",
    )
    return list(facts(p.snapshot.view(p.document, p.position), wanted))


def test_address_and_comment_of_an_operand_come_from_its_declaration() -> None:
    """IL-01: the columns beside the operand."""
    assert facts_of("XSWITCH", "gLimit", "GVL.gLimit", "fbDelay", "fbDelay.Q") == [
        OperandFacts("BOOL", "%IX0.3", "Main switch"),
        OperandFacts("REAL", "", "Upper"),
        OperandFacts("REAL", "", "Upper"),
        OperandFacts("TON", "", "Start delay"),
        OperandFacts("BOOL", "", "Delayed signal"),
    ]


@pytest.mark.parametrize("operand", ["", "nowhere", "iCount.", "(", "a, b", "'x", "%IX0.0", "1 +", "\n"])
def test_what_names_nothing_has_no_facts(operand: str) -> None:
    assert facts_of(operand) == [None]


def test_an_element_has_the_type_of_its_array() -> None:
    p = Project(
        PLC_PRG=f"{HEAD.replace('END_VAR', 'a : ARRAY[1..3] OF REAL; END_VAR')}|LD iCount\nEND_PROGRAM"
    )
    assert list(facts(p.snapshot.view(p.document, p.position), ["a[iCount]"])) == [
        OperandFacts("REAL", "", "")
    ]


def test_proposals_in_a_text_that_is_only_tried() -> None:
    """IL-04: the open cell of a table is no part of the text yet."""
    p = Project(PLC_PRG=f"{HEAD}|LD iCount\nEND_PROGRAM")
    tried = f"{HEAD}LD iCount\nEQ PLC_PRG.\nEND_PROGRAM"
    line = tried.split("\n").index("EQ PLC_PRG.")
    before = p.workspace.generation
    view = p.workspace.trial_view(p.document, Position(line, len("EQ PLC_PRG.")), tried)
    assert {"iCount", "iTotal", "xStart"} <= {item.label for item in proposals(view)}
    assert p.workspace.generation == before
    assert p.workspace.unsaved(p.document) is None
    with pytest.raises(ServiceError, match="belongs to no application"):
        p.workspace.trial_view("NOWHERE", Position(0, 0), "")
