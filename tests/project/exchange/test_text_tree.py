"""Trees of texts with one object a file: folders, members in files of their own, marks between the parts."""

import string

from hypothesis import given, settings
from hypothesis import strategies as st

from tappet.project.exchange.importing import import_files
from tappet.project.exchange.parts import st_files
from tappet.project.exchange.text_tree import folders_of, owner_paths, unmarked
from tappet.project.model import Project, ProjectObject

TREE = {
    "sync/Device/Application/Drives/Lift.st": """FUNCTION_BLOCK ABSTRACT Lift EXTENDS Drive
VAR_INPUT
    level : INT;
END_VAR
VAR
    // where it stands
    now : INT;
END_VAR

// === IMPLEMENTATION ===
// once a cycle
Travel();
Halt();
""",
    "sync/Device/Application/Drives/Lift.Travel.st": """METHOD PROTECTED Travel : BOOL
VAR
    step : INT := 1;
END_VAR

// === IMPLEMENTATION ===
now := now + step;
Travel := now = level;
""",
    "sync/Device/Application/Drives/Lift.Halt.st": "// === IMPLEMENTATION ===\nnow := level;\n",
    "sync/Device/Application/Drives/Lift.Height.st": """PROPERTY Height : INT

// === IMPLEMENTATION ===
// === GET ===
VAR
    raw : INT;
END_VAR
raw := now;
Height := raw;

// === SET ===
now := Height;
""",
    "sync/Device/Application/Drives/Lift.Door.st": """PROPERTY Door : BOOL

// === IMPLEMENTATION ===
// === SET ===
now := 0;
""",
    "sync/Device/Application/Drives/Drive.st": "FUNCTION_BLOCK Drive\n\n// === IMPLEMENTATION ===\n",
    "sync/Device/Application/Drives/ISlow.st": "INTERFACE ISlow\n",
    "sync/Device/Application/Drives/ISlow.Slow.st": "METHOD Slow : BOOL\n\n// === IMPLEMENTATION ===\n",
    "sync/Device/Application/Globals.st": "VAR_GLOBAL\n    lift : POINTER TO Lift;\nEND_VAR\n",
    "sync/Device/Application/PLC_PRG.st": "PROGRAM PLC_PRG\nVAR\nEND_VAR\n\n// === IMPLEMENTATION ===\n;\n",
}


def imported(files: dict[str, str]) -> tuple[Project, list[str]]:
    result = import_files({path: text.encode() for path, text in files.items()})
    return result.project, [entry.text for entry in result.report.noteworthy()]


def at(project: Project, *names: str) -> ProjectObject:
    found = project.find_kind("application")[0]
    for name in names:
        found = next(child for child in project.children(found.id) if child.name == name)
    return found


def test_members_in_files_of_their_own_go_into_their_block() -> None:
    project, notes = imported(TREE)
    assert notes == []
    lift = at(project, "Drives", "Lift")
    assert lift.data.declaration.endswith("now : INT;\nEND_VAR")
    assert lift.data.implementation == "// once a cycle\nTravel();\nHalt();"
    kinds = [(child.kind, child.name) for child in project.children(lift.id)]
    expected = [("action", "Halt"), ("method", "Travel"), ("property", "Door"), ("property", "Height")]
    assert sorted(kinds) == expected
    move = at(project, "Drives", "Lift", "Travel").data
    assert move.declaration == "METHOD PROTECTED Travel : BOOL\nVAR\n    step : INT := 1;\nEND_VAR"
    assert move.implementation == "now := now + step;\nTravel := now = level;"
    assert at(project, "Drives", "Lift", "Halt").data.implementation == "now := level;"
    assert at(project, "Drives", "Lift", "Height").data.declaration == "PROPERTY Height : INT"
    get = at(project, "Drives", "Lift", "Height", "Get").data
    assert (get.declaration, get.implementation) == (
        "VAR\n    raw : INT;\nEND_VAR",
        "raw := now;\nHeight := raw;",
    )
    assert at(project, "Drives", "Lift", "Height", "Set").data.implementation == "now := Height;"
    door = at(project, "Drives", "Lift", "Door")
    assert [child.name for child in project.children(door.id)] == ["Set"]
    assert at(project, "Drives", "ISlow", "Slow").kind == "method"


def test_folders_of_the_files_are_folders_of_the_project() -> None:
    project, _ = imported(TREE)
    assert at(project, "Drives").kind == "folder"
    assert at(project, "Globals").kind == "gvl"
    own = folders_of(["PLC/PLC Logic/App/a.st", "PLC/PLC Logic/App/Sub/b.st", "POUs/c.st"])
    assert own == {
        "PLC/PLC Logic/App/a.st": (),
        "PLC/PLC Logic/App/Sub/b.st": ("Sub",),
        "POUs/c.st": ("POUs",),
    }
    assert folders_of(["../x/a.st", "./x/y/b.st"]) == {"../x/a.st": (), "./x/y/b.st": ("y",)}


def test_a_dot_in_a_name_makes_no_member_of_an_object_that_stands_for_itself() -> None:
    files = {
        "Pump.st": "FUNCTION_BLOCK Pump\nEND_FUNCTION_BLOCK",
        "Pump.old.st": "PROGRAM Other\nEND_PROGRAM",
    }
    project, notes = imported(files)
    assert at(project, "Other").kind == "pou"
    assert notes == []
    assert owner_paths(["a/Pump.Run.st", "b/Pump.st", "a/v1.2.st", "a/v1.st"]) == {}


def test_a_member_without_its_block_is_told() -> None:
    _, notes = imported({"A.st": "PROGRAM A\nEND_PROGRAM", "Pump.Run.st": "METHOD Run\nEND_METHOD"})
    assert notes == ["there is no POU before it that the method belongs to"]


def test_in_texts_with_closing_keywords_the_marks_are_comments() -> None:
    text = "PROGRAM P\nVAR\nEND_VAR\n;\n// === IMPLEMENTATION ===\n;\nEND_PROGRAM\n"
    assert unmarked(text).text == text
    project, notes = imported({"P.st": text})
    assert at(project, "P").data.implementation == ";\n// === IMPLEMENTATION ===\n;"
    assert notes == []


lines = st.sampled_from(
    ["METHOD M", "PROPERTY P : INT", "VAR", "END_VAR", "x := 1;", "", "END_METHOD"]
    + [f"// {line} {mark} {line}" for line in ("===", "---") for mark in ("IMPLEMENTATION", "GET", "SET")]
)


@settings(max_examples=200, deadline=None)
@given(st.lists(lines, max_size=12))
def test_taking_marks_out_keeps_the_lines(given_lines: list[str]) -> None:
    text = "\n".join(given_lines)
    parted = unmarked(text)
    assert parted.text.count("\n") == text.count("\n")
    for end in parted.declaration_ends:
        assert "IMPLEMENTATION" in given_lines[parted.text.count("\n", 0, end)]
    done = import_files({"P.st": b"PROGRAM P\nEND_PROGRAM", "P.M.st": text.encode()})
    assert at(done.project, "P").kind == "pou"


names = st.text(string.ascii_uppercase, min_size=1, max_size=3).map(lambda text: f"{text}_{len(text)}")


@settings(max_examples=40, deadline=None)
@given(st.dictionaries(names, st.lists(names, max_size=3), min_size=1, max_size=6))
def test_our_own_texts_come_back_in_their_folders(blocks: dict[str, list[str]]) -> None:
    files = {
        "/".join(
            [*folders, f"FB_{name}.st"]
        ): f"FUNCTION_BLOCK FB_{name}\nMETHOD Run\n;\nEND_METHOD\nEND_FUNCTION_BLOCK"
        for name, folders in blocks.items()
    }
    files["PLC_PRG.st"] = "PROGRAM PLC_PRG\nEND_PROGRAM"  # so that no folder is shared by all
    first, _ = imported(files)
    texts = st_files(first)
    again, notes = imported(texts)
    assert st_files(again) == texts
    assert notes == []
