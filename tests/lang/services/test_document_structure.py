"""Outline, folding, semantic tokens, reports: what a whole document is made of."""

from __future__ import annotations

from marked_texts import Project, split_object

from tappet.lang.services.documents import Position, Program
from tappet.lang.services.folding import folds
from tappet.lang.services.hover import hover
from tappet.lang.services.outline import outline
from tappet.lang.services.reports import MAX_PER_DOCUMENT, reports
from tappet.lang.services.results import Outline
from tappet.lang.services.semantic_tokens import TOKEN_MODIFIERS, TOKEN_TYPES, semantic_tokens
from tappet.lang.services.workspace import Workspace

FB = """(* Motor *)
FUNCTION_BLOCK FB_Motor
VAR_INPUT
    xOn : BOOL;
END_VAR
VAR CONSTANT
    c_i : INT := 5;
END_VAR
METHOD Go : BOOL
VAR
    t : TIME;
END_VAR
IF xOn THEN
    Go := TRUE;
END_IF
END_METHOD
PROPERTY P : ARRAY[0..1] OF INT
GET
END_GET
END_PROPERTY
{region 'body'}
/* two
   lines */
{endregion}
END_FUNCTION_BLOCK
"""


def tree(entries: list[Outline]) -> list[object]:
    return [
        (e.name, str(e.kind), e.detail, tree(e.children)) if e.children else (e.name, str(e.kind), e.detail)
        for e in entries
    ]


def test_outline_of_a_block() -> None:
    project = Project(FB_Motor=FB)
    (entry,) = outline(project.snapshot, "FB_Motor")
    assert tree([entry]) == [
        (
            "FB_Motor",
            "function_block",
            "",
            [
                ("VAR_INPUT", "section", "", [("xOn", "variable", "BOOL")]),
                ("VAR CONSTANT", "section", "", [("c_i", "constant", "INT")]),
                ("Go", "method", "BOOL", [("VAR", "section", "", [("t", "variable", "TIME")])]),
                ("P", "property", "ARRAY[0..1] OF INT"),
            ],
        )
    ]
    assert (entry.span.line, entry.span.end_line, entry.name_span.line) == (1, 24, 1)


def test_outline_of_other_objects() -> None:
    project = Project(
        T=(
            "TYPE S : STRUCT a : INT; END_STRUCT; E : (x, y); A : STRING(5); U : "
            "UNION q : INT; END_UNION END_TYPE"
        ),
        G="VAR_GLOBAL g : INT; END_VAR",
        I="INTERFACE I METHOD m : INT END_METHOD PROPERTY p : INT END_PROPERTY END_INTERFACE",
        F="FUNCTION F : REAL END_FUNCTION",
    )
    snapshot = project.snapshot
    assert tree(outline(snapshot, "T")) == [
        ("S", "struct", "", [("a", "field", "INT")]),
        ("E", "enum", "", [("x", "enum_value", ""), ("y", "enum_value", "")]),
        ("A", "type", "STRING(5)"),
        ("U", "union", "", [("q", "field", "INT")]),
    ]
    assert tree(outline(snapshot, "G")) == [("G", "global_list", "", [("g", "variable", "INT")])]
    assert tree(outline(snapshot, "I")) == [
        ("I", "interface", "", [("m", "method", "INT"), ("p", "property", "INT")]),
    ]
    assert tree(outline(snapshot, "F")) == [("F", "function", "REAL")]


def test_outline_of_jump_labels() -> None:
    text = split_object(
        "P",
        "PROGRAM P\nVAR\n  a : INT;\nEND_VAR",
        "Begin: a := 1;\nIF a = 1 THEN\n  Inner: a := 2;\nEND_IF\nJMP Begin;\nDone:\n",
        "END_PROGRAM",
    )
    snapshot = Workspace(lambda unsaved: [Program("App", [text])]).snapshot("P/declaration")
    (entry,) = outline(snapshot, "P/implementation")
    assert [(e.name, str(e.kind), e.name_span[:2]) for e in entry.children] == [
        ("Begin", "label", (0, 0)),
        ("Inner", "label", (2, 2)),
        ("Done", "label", (5, 0)),
    ]
    (entry,) = outline(snapshot, "P/declaration")
    assert [child.name for child in entry.children] == ["VAR"]
    rows = Project(
        Q="PROGRAM Q\nVAR i : INT; END_VAR\nAgain: LD i\nADD 1\nST i\nJMP Again\nEND_PROGRAM",
        F="FUNCTION_BLOCK F\nPROPERTY p : INT\nGET\nHere: p := 1;\nEND_GET\nEND_PROPERTY\nEND_FUNCTION_BLOCK",
    ).snapshot
    (entry,) = outline(rows, "Q")
    assert [(e.name, str(e.kind)) for e in entry.children] == [("VAR", "section"), ("Again", "label")]
    (entry,) = outline(rows, "F")
    assert tree(entry.children) == [("p", "property", "INT", [("Here", "label", "")])]


def test_documents_of_one_object() -> None:
    text = split_object(
        "P", "PROGRAM P\nVAR\n  a : INT;\nEND_VAR", "IF a = 1 THEN\n  a := 2;\nEND_IF\n", "END_PROGRAM"
    )
    snapshot = Workspace(lambda unsaved: [Program("App", [text])]).snapshot("P/declaration")
    (entry,) = outline(snapshot, "P/declaration")
    assert (entry.name, entry.span[:3], [child.name for child in entry.children]) == ("P", (0, 0, 3), ["VAR"])
    (body,) = outline(snapshot, "P/implementation")
    assert (body.name, body.children, body.span.line, body.span.end_line) == ("P", [], 0, 3)
    assert [(f.start, f.end) for f in folds(snapshot, "P/declaration")] == [(0, 3), (1, 3)]
    assert [(f.start, f.end) for f in folds(snapshot, "P/implementation")] == [(0, 3), (0, 2)]
    assert [(t.line, t.type) for t in semantic_tokens(snapshot, "P/implementation")][:3] == [
        (0, "keyword"),
        (0, "variable"),
        (0, "operator"),
    ]


def test_folding() -> None:
    found = {(f.start, f.end, f.kind) for f in folds(Project(FB_Motor=FB).snapshot, "FB_Motor")}
    assert found == {
        (1, 24, "code"),
        (2, 4, "code"),
        (5, 7, "code"),
        (8, 15, "code"),
        (9, 11, "code"),
        (12, 14, "code"),
        (16, 19, "code"),
        (17, 18, "code"),
        (20, 23, "region"),
        (21, 22, "comment"),
    }


def test_a_string_over_lines_is_a_token_on_each() -> None:
    project = Project(P="PROGRAM P\nVAR s : STRING; END_VAR\ns := 'one\n  two';\nEND_PROGRAM")
    tokens = [t for t in semantic_tokens(project.snapshot, "P") if t.type == "string"]
    assert [t[:3] for t in tokens] == [(2, 5, 4), (3, 0, 6)]


def test_semantic_tokens_name_what_each_word_is() -> None:
    project = Project(
        P="PROGRAM P\nVAR\n  m : FB; e : E := On; i : INT; s : S; t : TON;\nEND_VAR\n"
        "m(x := TRUE); // c\ni := g + c + F(1) + s.q + LIMIT(1, i, 3);\nl: "
        "JMP l;\n{info 'x'} m.Go(); m.Pr := 'a'; e := E.On;\n"
        "i := %IW0;\nEND_PROGRAM",
        FB="FUNCTION_BLOCK FB VAR_INPUT x : BOOL; END_VAR METHOD Go END_METHOD "
        "PROPERTY Pr : INT SET END_SET END_PROPERTY "
        "END_FUNCTION_BLOCK",
        E="TYPE E : (On); END_TYPE",
        S="TYPE S : STRUCT q : INT; END_STRUCT END_TYPE",
        Globals="VAR_GLOBAL g : INT; END_VAR VAR_GLOBAL CONSTANT c : INT := 1; END_VAR",
        F="FUNCTION F : INT VAR_INPUT a : INT; END_VAR END_FUNCTION",
    )
    lines = project.objects["P"].split("\n")
    found = {
        (token.line + 1, lines[token.line][token.column : token.column + token.length]): (
            token.type,
            set(token.modifiers),
        )
        for token in semantic_tokens(project.snapshot, "P")
    }
    expected = {
        (1, "PROGRAM"): ("keyword", set()),
        (1, "P"): ("namespace", {"declaration"}),
        (3, "m"): ("variable", {"declaration"}),
        (3, "FB"): ("class", set()),
        (3, "E"): ("enum", set()),
        (3, "On"): ("enumMember", {"readonly"}),
        (3, "INT"): ("type", {"defaultLibrary"}),
        (3, "S"): ("struct", set()),
        (3, "TON"): ("class", {"defaultLibrary"}),
        (5, "x"): ("parameter", {"modification"}),
        (5, "TRUE"): ("keyword", set()),
        (5, "// c"): ("comment", set()),
        (6, "g"): ("variable", {"static"}),
        (6, "c"): ("variable", {"static", "readonly"}),
        (6, "F"): ("function", set()),
        (6, "q"): ("variable", set()),
        (6, "LIMIT"): ("function", {"defaultLibrary"}),
        (6, "3"): ("number", set()),
        (6, "+"): ("operator", set()),
        (7, "l"): ("label", set()),
        (8, "{info 'x'}"): ("macro", set()),
        (8, "Go"): ("method", set()),
        (8, "Pr"): ("property", {"modification"}),
        (8, "'a'"): ("string", set()),
        (9, "%IW0"): ("variable", {"static"}),
    }
    assert {key: found.get(key) for key in expected} == {
        key: (type_, modifiers if key != (6, "c") else found[6, "c"][1])
        for key, (type_, modifiers) in expected.items()
    }
    assert found[6, "c"][1] >= {"readonly"}
    assert all(
        type_ in TOKEN_TYPES and modifiers <= set(TOKEN_MODIFIERS) for type_, modifiers in found.values()
    )


def test_inactive_text_is_marked() -> None:
    project = Project(P="PROGRAM P\n{IF FALSE}\na := 1;\n{END_IF}\nEND_PROGRAM")
    found = [t for t in semantic_tokens(project.snapshot, "P") if t.line == 2]
    assert found
    assert all(t.modifiers == {"inactive"} for t in found)


def test_reports_stand_in_the_right_document() -> None:
    text = split_object("P", "PROGRAM P\nVAR\n  a : INTT;\nEND_VAR", "b := 1;\nIF TRUE THEN", "END_PROGRAM")
    snapshot = Workspace(lambda unsaved: [Program("App", [text])]).snapshot("P/declaration")
    found = reports(snapshot)
    assert [(r.code, r.span[:2]) for r in found["P/declaration"] if r.severity == "error"] == [
        ("E0202", (2, 6))
    ]
    by_code = {r.code: r for r in found["P/implementation"]}
    assert by_code["E0201"].span[:3] == (0, 0, 0)
    assert by_code["E0103"].span.line == 1  # the compiler's END_PROGRAM is in no document
    assert by_code["E0103"].severity == "error"
    assert by_code["E0103"].advice


def test_reports_name_related_places() -> None:
    project = Project(P="PROGRAM P\nVAR\n  a : INT;\n  A : INT;\nEND_VAR\nEND_PROGRAM")
    (found,) = [r for r in reports(project.snapshot)["P"] if r.code == "E0205"]
    assert [(r.place.document, r.place.span.line) for r in found.related] == [("P", 2)]


def test_lines_are_counted_as_editors_count_them() -> None:
    text = "PROGRAM P // \x0c form feed \u2028 and more\nVAR a : INT := 1; END_VAR\na := a;\nEND_PROGRAM"
    snapshot = Project(P=text).snapshot
    explained = hover(snapshot, "P", Position(2, 0))
    assert explained is not None
    assert explained.code == "VAR a : INT := 1;"


def test_reports_are_limited() -> None:
    project = Project(P="PROGRAM P\n" + "x.;\n" * (MAX_PER_DOCUMENT + 50) + "END_PROGRAM")
    assert len(reports(project.snapshot)["P"]) == MAX_PER_DOCUMENT


def test_libraries_are_not_reported() -> None:
    assert all(not document.startswith("tappet-library") for document in reports(Project(P="").snapshot))
