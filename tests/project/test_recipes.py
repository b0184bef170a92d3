"""Recipes in the controller: the methods of RecipeManCommands, run on the compiled project."""

from __future__ import annotations

import random
import struct
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from pydantic import ValidationError
from recipe_projects import DARK, NUMBERS, PATHS, build, package, project_of

from tappet.iec.places import Span
from tappet.project import edit
from tappet.project.model import Project
from tappet.project.recipes.definition import RecipeDefinitionData, RecipeManagerData
from tappet.project.sources import application_sources
from tappet.runtime.local import LocalRuntime

ERR_OK, ERR_FAILED, ERR_PARAMETER = 0, 1, 2
FILE_NOT_FOUND, MISMATCH, SAVE_ERR = 0x4000, 0x4001, 0x4002
RECIPE_NOT_FOUND, DEFINITION_NOT_FOUND, EXISTS, NO_MANAGER = 0x4003, 0x4004, 0x4005, 0x4006
LIGHT_VALUES = (
    True, 7, 0xF0, 2**64 - 1, 1.25, 0.1, 90_000, 1772236800, "it's", "Brötchen", 5, -5,
)  # fmt: skip
"""What the literals of the recipe Light are; the date is a Unix time."""
LIGHT_FILE = [
    "PLC_PRG.xFan:=TRUE",
    "PLC_PRG.nLevel:=7",
    "PLC_PRG.byMask:=240",
    "PLC_PRG.uliSerial:=18446744073709551615",
    "PLC_PRG.rSpeed:=1.25",
    "PLC_PRG.fTemperature:=0.1",
    "PLC_PRG.tBake:=T#1m30s",
    "PLC_PRG.dStart:=D#2026-02-28",
    "PLC_PRG.sLabel:='it$'s'",
    'PLC_PRG.wsTitle:="Br$00F6tchen"',
    "PLC_PRG.eMode:=5",
    "PLC_PRG.aStep[2].nTime:=-5",
]


class Machine:
    """A running project and its folder of files."""

    def __init__(self, runtime: LocalRuntime, files: Path) -> None:
        self.runtime = runtime
        self.files = files

    def command(self, name: str, recipe: str = "Dark", **values: Any) -> int:
        """Has the program call a method once; what it returned."""
        done = self.runtime.read("PLC_PRG.nDone")
        written = {"sRecipe": recipe, **values, "nOrder": NUMBERS[name]}
        self.runtime.write_all({f"PLC_PRG.{key}": value for key, value in written.items()})
        self.runtime.run(cycles=2)
        assert self.runtime.read("PLC_PRG.nDone") == done + 1  # type: ignore[operator]
        result = self.runtime.read("PLC_PRG.dwResult")
        assert isinstance(result, int)
        return result

    @property
    def values(self) -> tuple[Any, ...]:
        return tuple(self.runtime.read(path) for path in PATHS)

    @property
    def problem(self) -> str:
        return str(self.runtime.read("PLC_PRG.sProblem"))

    def lines(self, name: str) -> list[str]:
        return (self.files / name).read_text("latin-1").splitlines()

    def texts(self) -> list[str]:
        found = self.runtime.read("PLC_PRG.asTexts")
        assert isinstance(found, list)
        return [str(text) for text in found]


Start = Callable[..., Machine]


@pytest.fixture
def start(tmp_path: Path) -> Iterator[Start]:
    """Starts a project on one folder, in place of the one before."""
    running: list[LocalRuntime] = []

    def begin(project: Project | None = None) -> Machine:
        while running:
            running.pop().close()
        running.append(LocalRuntime(package(project or project_of()), folder=tmp_path))
        return Machine(running[0], tmp_path / "files")

    yield begin
    while running:
        running.pop().close()


# -- read, write ---------------------------------------------------------------------------------------


def test_a_recipe_of_the_project_is_written(start: Start) -> None:
    machine = start()
    assert machine.command("WriteRecipe", "Light") == ERR_OK
    assert machine.values == LIGHT_VALUES
    assert machine.command("WriteRecipe", "DARK") == ERR_OK, "case does not count"
    assert machine.runtime.read("PLC_PRG.nLevel") == -3
    assert machine.runtime.read("PLC_PRG.sLabel") == ""
    assert machine.runtime.read("PLC_PRG.fTemperature") == 1e300


def test_present_values_are_read_into_a_recipe(start: Start) -> None:
    machine = start()
    machine.runtime.write_all({"PLC_PRG.nLevel": 123, "PLC_PRG.sLabel": "now"})
    assert machine.command("ReadRecipe") == ERR_OK
    machine.runtime.write_all({"PLC_PRG.nLevel": 4, "PLC_PRG.sLabel": ""})
    assert machine.command("WriteRecipe") == ERR_OK
    assert machine.runtime.read("PLC_PRG.nLevel") == 123
    assert machine.runtime.read("PLC_PRG.sLabel") == "now"


def test_recipes_are_created_counted_listed_and_deleted(start: Start) -> None:
    machine = start()
    machine.runtime.write("PLC_PRG.nLevel", 55)
    assert machine.command("CreateRecipe", "Rye") == ERR_OK
    assert machine.runtime.read("PLC_PRG.nCount") == 3
    assert machine.command("CreateRecipe", "rye") == EXISTS
    assert machine.command("GetRecipeNames") == ERR_OK
    assert machine.texts()[:4] == ["Light", "Dark", "Rye", ""]
    assert machine.command("GetRecipeNames", nFirst=2) == ERR_OK
    assert machine.texts()[0] == "Rye"
    assert (machine.files / "Rye.Bread.txtrecipe").exists()
    assert machine.command("DeleteRecipe", "Light") == ERR_OK
    assert machine.command("GetRecipeNames", nFirst=0) == ERR_OK
    assert machine.texts()[:2] == ["Dark", "Rye"]
    assert machine.command("DeleteRecipe", "Light") == RECIPE_NOT_FOUND
    machine.runtime.write("PLC_PRG.nLevel", 1)
    assert machine.command("WriteRecipe", "Rye") == ERR_OK
    assert machine.runtime.read("PLC_PRG.nLevel") == 55
    assert machine.command("DeleteRecipeFile", "Rye") == ERR_OK
    assert machine.command("DeleteRecipeFile", "Rye") == FILE_NOT_FOUND


@pytest.mark.parametrize("name", ["", "../out", "a/b", ".hidden", "a\\b"])
def test_a_recipe_is_no_path(start: Start, name: str) -> None:
    assert start().command("CreateRecipe", name) == ERR_PARAMETER


def test_values_as_texts(start: Start) -> None:
    machine = start()
    assert machine.command("GetRecipeValues", "Light") == ERR_OK
    assert machine.texts() == [line.partition(":=")[2] for line in LIGHT_FILE][:10]
    assert machine.command("GetRecipeVariableNames", nFirst=9) == ERR_OK
    assert machine.texts()[:3] == list(PATHS[9:])
    texts = ["FALSE", "-9", "16#0F", *(line.partition(":=")[2] for line in LIGHT_FILE[3:10])]
    given = {f"asTexts[{number}]": text for number, text in enumerate(texts)}
    # a text between quotes would be taken as the literal that it is
    given["asTexts[8]"] = "'$'it$$$'s$''"
    assert machine.command("SetRecipeValues", "Light", nFirst=0, **given) == ERR_OK
    assert machine.command("WriteRecipe", "Light") == ERR_OK
    assert machine.values[:4] == (False, -9, 15, 2**64 - 1)
    assert machine.command("SetRecipeValues", "Light", **{"asTexts[0]": "TRUE", "asTexts[1]": "40000"}) == 1
    assert machine.problem == "the value does not fit PLC_PRG.nLevel"
    assert machine.command("WriteRecipe", "Light") == ERR_OK
    assert machine.values[:2] == (False, -9), "none of the values was taken"


def test_what_does_not_exist_is_told(start: Start) -> None:
    machine = start()
    for name in ("ReadRecipe", "WriteRecipe", "LoadRecipe", "SaveRecipe", "LoadAndWriteRecipe"):
        assert machine.command(name, "None") == RECIPE_NOT_FOUND
    assert machine.command("WriteOfNone") == DEFINITION_NOT_FOUND
    assert machine.runtime.read("PLC_PRG.dwLast") == DEFINITION_NOT_FOUND
    assert machine.command("LoadRecipe", "Light") == FILE_NOT_FOUND
    assert machine.command("LoadFromAndWriteRecipe", "Light", sFile="gone.txtrecipe") == FILE_NOT_FOUND
    assert machine.command("ReadAndSaveRecipeAs", "Light", sFile="../out") == SAVE_ERR


def test_values_stay_within_the_limits(start: Start) -> None:
    definition = {
        "variables": [
            {"path": "PLC_PRG.nLevel", "minimum": "-10", "maximum": "20"},
            {"path": "PLC_PRG.fTemperature", "minimum": "0.5", "maximum": "99.5"},
            {"path": "PLC_PRG.tBake", "maximum": "T#1h"},
            {"path": "PLC_PRG.uliSerial", "minimum": "9223372036854775808"},
        ],
        "recipes": [
            {
                "name": "Light",
                "values": {
                    "PLC_PRG.nLevel": "21", "PLC_PRG.fTemperature": "0.25", "PLC_PRG.tBake": "T#2h",
                    "PLC_PRG.uliSerial": "1",
                },
            },
            {"name": "Dark", "values": {"PLC_PRG.nLevel": "-11", "PLC_PRG.fTemperature": "100"}},
        ],
    }  # fmt: skip
    machine = start(project_of(definition))
    assert machine.command("WriteRecipe", "Light") == ERR_OK
    names = ("nLevel", "fTemperature", "tBake", "uliSerial")
    assert [machine.runtime.read(f"PLC_PRG.{n}") for n in names] == [20, 0.5, 3_600_000, 2**63]
    assert machine.command("WriteRecipe", "Dark") == ERR_OK
    assert [machine.runtime.read(f"PLC_PRG.{n}") for n in names[:2]] == [-10, 99.5]


# -- files ---------------------------------------------------------------------------------------------


def test_a_saved_file_has_a_line_a_variable(start: Start) -> None:
    machine = start()
    assert machine.command("SaveRecipe", "Light") == ERR_OK
    assert machine.lines("Light.Bread.txtrecipe") == LIGHT_FILE
    assert [path.name for path in machine.files.iterdir()] == ["Light.Bread.txtrecipe"]


def test_a_file_is_loaded(start: Start) -> None:
    machine = start()
    machine.files.mkdir(exist_ok=True)
    text = "\r\n".join(reversed(LIGHT_FILE)).replace(":=7", " := INT#8 ").replace("240", "2#11")
    (machine.files / "Dark.Bread.txtrecipe").write_text(f"\ufeff{text}\n", "utf-8")
    assert machine.command("LoadAndWriteRecipe", "Dark") == ERR_OK
    assert machine.values == (True, 8, 3, *LIGHT_VALUES[3:])
    (machine.files / "one.txt").write_text("plc_prg.nlevel:=9\n")
    assert machine.command("LoadFromAndWriteRecipe", "", sFile="one.txt") == ERR_OK
    assert machine.values[:3] == (True, 9, 3), "what is not in the file stays"
    assert machine.command("WriteRecipe", "Dark") == ERR_OK
    assert machine.values[1] == 8, "no recipe was changed"


@pytest.mark.parametrize(
    ("line", "problem"),
    [
        ("PLC_PRG.nLevel=5", "line 2: no separator"),
        ("PLC_PRG.nLevel:=40000", "line 2: the value does not fit PLC_PRG.nLevel"),
        ("PLC_PRG.nLevel:=", "line 2: the value does not fit PLC_PRG.nLevel"),
        ("PLC_PRG.nLevel:=5 6", "line 2: the value does not fit PLC_PRG.nLevel"),
        ("PLC_PRG.xFan:=2", "line 2: the value does not fit PLC_PRG.xFan"),
        ("PLC_PRG.byMask:=-1", "line 2: the value does not fit PLC_PRG.byMask"),
        ("PLC_PRG.rSpeed:=1E39", "line 2: the value does not fit PLC_PRG.rSpeed"),
        ("PLC_PRG.rSpeed:=fast", "line 2: the value does not fit PLC_PRG.rSpeed"),
        ("PLC_PRG.tBake:=5", "line 2: the value does not fit PLC_PRG.tBake"),
        ("PLC_PRG.tBake:=T#", "line 2: the value does not fit PLC_PRG.tBake"),
        ("PLC_PRG.dStart:=D#2026-02-30", "line 2: the value does not fit PLC_PRG.dStart"),
        ("PLC_PRG.sLabel:='thirteen long'", "line 2: the value does not fit PLC_PRG.sLabel"),
        ("PLC_PRG.sLabel:=plain", "line 2: the value does not fit PLC_PRG.sLabel"),
        ("PLC_PRG.sLabel:='a'b'", "line 2: the value does not fit PLC_PRG.sLabel"),
        ("PLC_PRG.sLabel:='a$", "line 2: the value does not fit PLC_PRG.sLabel"),
    ],
)
def test_a_wrong_line_changes_nothing(start: Start, line: str, problem: str) -> None:
    machine = start()
    machine.files.mkdir(exist_ok=True)
    (machine.files / "x").write_text(f"PLC_PRG.uliSerial:=77\n{line}\n")
    before = machine.values
    assert machine.command("LoadFromAndWriteRecipe", "Dark", sFile="x") == MISMATCH
    assert machine.problem == problem
    assert machine.values == before
    assert machine.command("GetRecipeValues", "Dark") == ERR_OK
    assert machine.texts()[3] == "2"


def test_an_exact_match_is_asked_for(start: Start) -> None:
    machine = start(project_of(exact_match=True))
    machine.files.mkdir(exist_ok=True)
    (machine.files / "x").write_text("\n".join(LIGHT_FILE[:-1]))
    assert machine.command("LoadFromAndWriteRecipe", "Dark", sFile="x") == MISMATCH
    assert machine.problem == "line 11: the file ends, but variables are missing"
    (machine.files / "x").write_text("\n".join([*LIGHT_FILE, "PLC_PRG.nOther:=1"]))
    assert machine.command("LoadFromAndWriteRecipe", "Dark", sFile="x") == MISMATCH
    assert machine.problem == "line 13: the definition has no variable PLC_PRG.nOther"
    (machine.files / "x").write_text("\n".join(LIGHT_FILE))
    assert machine.command("LoadFromAndWriteRecipe", "Dark", sFile="x") == ERR_OK


def test_columns_separator_folder_and_ending(start: Start) -> None:
    definition = {
        "variables": [
            {"path": "PLC_PRG.nLevel", "name": "Level", "minimum": "1", "maximum": "9", "comment": "of heat"},
            {"path": "PLC_PRG.sLabel"},
        ],
        "recipes": [{"name": "Dark", "values": {"PLC_PRG.nLevel": "3", "PLC_PRG.sLabel": "'a;b$'c'"}}],
    }
    columns = ["name", "type", "value", "minimum", "maximum", "comment", "variable"]
    project = project_of(definition, columns=columns, separator=";", path="oven/today", extension="csv")
    machine = start(project)
    assert machine.command("SaveRecipe") == ERR_OK
    assert machine.lines("oven/today/Dark.Bread.csv") == [
        "Level;INT;3;1;9;of heat;PLC_PRG.nLevel",
        ";STRING;'a;b$'c';;;;PLC_PRG.sLabel",
    ]
    machine.runtime.write_all({"PLC_PRG.nLevel": 0, "PLC_PRG.sLabel": ""})
    assert machine.command("LoadAndWriteRecipe") == ERR_OK
    assert machine.runtime.read("PLC_PRG.nLevel") == 3
    assert machine.runtime.read("PLC_PRG.sLabel") == "a;b'c"


def test_binary_files_fit_the_same_variables_only(start: Start) -> None:
    machine = start(project_of(storage="binary"))
    assert machine.command("SaveRecipe", "Light") == ERR_OK
    file = machine.files / "Light.Bread.txtrecipe"
    content = file.read_bytes()
    assert struct.pack("<?hBQfd", True, 7, 0xF0, 2**64 - 1, 1.25, 0.1) in content
    assert machine.command("LoadFromAndWriteRecipe", "Dark", sFile=file.name) == ERR_OK
    assert machine.values == LIGHT_VALUES
    for damaged in (content[:-1], content + b"x", b"", b"\0" + content[1:], content[:5] + b"?" + content[6:]):
        file.write_bytes(damaged)
        assert machine.command("LoadFromAndWriteRecipe", "Dark", sFile=file.name) == MISMATCH


def test_recipes_are_those_of_the_files_after_a_start(start: Start) -> None:
    machine = start()
    machine.runtime.write("PLC_PRG.nLevel", 321)
    assert machine.command("ReadRecipe", "Dark") == ERR_OK, "saved by itself"
    assert machine.command("CreateRecipe", "Rye") == ERR_OK
    assert machine.command("CreateRecipeNoSave", "Gone") == ERR_OK
    (machine.files / "Bad.Bread.txtrecipe").write_text("PLC_PRG.nLevel:=x")
    (machine.files / "Dark.Cake.txtrecipe").write_text("PLC_PRG.nLevel:=1")
    machine = start()
    assert machine.command("GetRecipeNames") == ERR_OK
    assert [text for text in machine.texts() if text] == ["Light", "Dark", "Rye"]
    for name, level in (("Dark", 321), ("Rye", 321), ("Light", 7)):
        assert machine.command("WriteRecipe", name) == ERR_OK
        assert machine.runtime.read("PLC_PRG.nLevel") == level
    machine = start(project_of(load_at_start=False))
    assert machine.command("WriteRecipe", "Dark") == ERR_OK
    assert machine.runtime.read("PLC_PRG.nLevel") == -3


def test_without_saving_by_itself_no_file_comes(start: Start) -> None:
    machine = start(project_of(save_changes=False))
    assert machine.command("ReadRecipe", "Dark") == ERR_OK
    assert machine.command("CreateRecipeNoSave", "Rye") == ERR_OK
    assert list(machine.files.iterdir()) == []


def test_a_manager_that_is_not_in_the_controller(start: Start) -> None:
    assert start(project_of(in_controller=False)).command("WriteRecipe") == NO_MANAGER


@pytest.mark.parametrize("storage", ["textual", "binary"])
def test_any_value_comes_back_from_a_file(start: Start, storage: str) -> None:
    """The model of a file is the machine's own variables before it was written."""
    machine = start(project_of(storage=storage))
    chance = random.Random(5)
    bits = [struct.unpack("<d", chance.randbytes(8))[0] for _ in range(30)]
    numbers = [n for n in bits if n == n and abs(n) != float("inf")] + [
        0.0,
        -0.0,
        5e-324,
        1.7976931348623157e308,
    ]
    for number in numbers:
        text = "".join(
            chr(chance.choice([*range(32, 127), 9, 10, 13, 0xE9])) for _ in range(chance.randint(0, 12))
        )
        wide = "".join(chr(chance.randint(1, 0xD7FF)) for _ in range(chance.randint(0, 12)))
        single = struct.unpack(
            "<f", struct.pack("<f", chance.uniform(-1, 1) * 10 ** chance.randint(-30, 30))
        )[0]
        values = (
            chance.random() < 0.5, chance.randint(-(2**15), 2**15 - 1), chance.randint(0, 255),
            chance.randint(0, 2**64 - 1), single, number, chance.randint(0, 2**32 - 1),
            86400 * chance.randint(0, 40000),
            text, wide, chance.choice([0, 3, 5]), chance.randint(-(2**15), 2**15 - 1),
        )  # fmt: skip
        machine.runtime.write_all(dict(zip(PATHS, values, strict=True)))
        assert machine.command("ReadAndSaveAs", sFile="x") == ERR_OK
        assert machine.command("WriteRecipe", "Dark") == ERR_OK
        assert machine.command("LoadFromAndWriteRecipe", "", sFile="x") == ERR_OK, machine.problem
        assert machine.values == values


# -- the project ---------------------------------------------------------------------------------------


def test_what_does_not_fit_is_an_error_at_its_cell() -> None:
    definition = {
        "variables": [
            {"path": "PLC_PRG.nLevel", "minimum": "'low'"},
            {"path": "PLC_PRG.nNone"},
            {"path": "PLC_PRG.aStep[1]"},
            {"path": "PLC_PRG.sLabel; x := 1"},
            {"path": "PLC_PRG.xFan"},
        ],
        "recipes": [
            {"name": "Light", "values": {"PLC_PRG.nLevel": "40000", "PLC_PRG.xFan": "2 + 2"}},
            {"name": "Dark", "values": {"PLC_PRG.xFan": "'on'"}},
        ],
    }
    project = project_of(definition)
    result = build(project)
    (item,) = project.find_kind("recipe_definition")
    (application,) = project.applications()
    sources = {source.uri: source for source in application_sources(project, application.id)}
    found = set()
    for error in result.diagnostics:
        if error.severity == "error":
            place = sources[error.uri].map.place(error.span)
            assert place.object_id == item.id, str(error)
            found.add(place.element)
    assert found == {
        "PLC_PRG.nLevel / minimum",
        "PLC_PRG.nLevel / recipe Light",
        "PLC_PRG.nNone",
        "PLC_PRG.aStep[1]",
        "PLC_PRG.sLabel; x := 1",
        "PLC_PRG.xFan / recipe Light",
        "PLC_PRG.xFan / recipe Dark",
    }


@pytest.mark.parametrize("recipes", [[], [{"name": "Light", "values": {"PLC_PRG.gone": "1"}}]])
def test_a_definition_without_variables(start: Start, recipes: list[Any]) -> None:
    project = project_of({"variables": [], "recipes": recipes})
    assert start(project).command("CreateRecipe", "Rye") == ERR_OK
    (item,) = project.find_kind("recipe_definition")
    (application,) = project.applications()
    (source,) = [
        s for s in application_sources(project, application.id) if "RecipeDefinition_Bread" in s.text
    ]
    lines = range(source.text.count("\n") + 1)
    assert {source.map.place(Span(line, 0, line, 1)).object_id for line in lines} == {item.id}


def test_an_online_change_takes_over_edited_recipes(start: Start) -> None:
    project = project_of()
    machine = start(project)
    first = machine.runtime.package
    assert machine.command("WriteRecipe", "Light") == ERR_OK
    (item,) = project.find_kind("recipe_definition")
    data = item.data_as(RecipeDefinitionData).model_dump()
    data["variables"].insert(0, {"path": "PLC_PRG.aStep[1].nTime"})
    data["recipes"][0]["values"] |= {"PLC_PRG.aStep[1].nTime": "11", "PLC_PRG.nLevel": "12"}
    changed = package(edit.change_data(project, item.id, data), first)
    machine.runtime.plc.download(changed.to_bytes(), "online_change")
    assert machine.command("WriteRecipe", "Light") == ERR_OK
    assert machine.runtime.read("PLC_PRG.aStep[1].nTime") == 11
    assert machine.values == (True, 12, *LIGHT_VALUES[2:])


def test_a_renamed_program_is_followed() -> None:
    project = project_of()
    (program,) = project.find_kind("pou")
    project = edit.rename_object(project, program.id, "Oven")
    (item,) = project.find_kind("recipe_definition")
    data = item.data_as(RecipeDefinitionData)
    assert [variable.path for variable in data.variables] == [p.replace("PLC_PRG", "Oven") for p in PATHS]
    assert list(data.recipes[0].values) == [path.replace("PLC_PRG", "Oven") for path in PATHS]
    assert list(data.recipes[1].values.values()) == list(DARK.values())
    package(project)


@pytest.mark.parametrize(
    "wrong",
    [
        {"variables": [{"path": "a.b"}, {"path": "A.B"}]},
        {"recipes": [{"name": "x"}, {"name": "X"}]},
        {"recipes": [{"name": "a/b"}]},
        {"recipes": [{"name": ""}]},
    ],
)
def test_definitions_that_are_refused(wrong: dict[str, Any]) -> None:
    with pytest.raises(ValidationError):
        RecipeDefinitionData.model_validate(wrong)


@pytest.mark.parametrize(
    "wrong",
    [
        {"path": "../x"}, {"path": "/x"}, {"path": "a\\b"}, {"extension": "a/b"}, {"separator": ""},
        {"columns": ["value"]}, {"columns": ["variable", "value", "value"]}, {"storage": "xml"},
    ],
)  # fmt: skip
def test_settings_that_are_refused(wrong: dict[str, Any]) -> None:
    with pytest.raises(ValidationError):
        RecipeManagerData.model_validate(wrong)
