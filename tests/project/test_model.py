"""The tree and the data of its objects (seam 5; CON-01..CON-09, TASK-11, TASK-17)."""

import json

import pytest

from tappet.project.data import UnknownData
from tappet.project.errors import InvalidDataError, UnknownObjectError
from tappet.project.kind_registry import kinds
from tappet.project.model import Project, new_id
from tappet.project.new_project import new_project
from tappet.project.objects import changed_object, make_object


def test_the_new_project() -> None:
    project = new_project("Press")
    assert [project.path_of(item.id) for item in project.walk()] == [
        "Tappet Soft PLC",
        "Tappet Soft PLC/PLC Logic",
        "Tappet Soft PLC/PLC Logic/Application",
        "Tappet Soft PLC/PLC Logic/Application/Library Manager",
        "Tappet Soft PLC/PLC Logic/Application/PLC_PRG",
        "Tappet Soft PLC/PLC Logic/Application/Task Configuration",
        "Tappet Soft PLC/PLC Logic/Application/Task Configuration/MainTask",
    ]
    task = project.find("tappet soft plc/plc logic/application/task configuration/maintask")
    assert task is not None
    assert task.model_dump()["data"] == {
        "priority": 1,
        "type": "cyclic",
        "interval": "T#20ms",
        "event": "",
        "group": "",
        "watchdog": {"enabled": False, "time": "T#100ms", "percent": None, "sensitivity": 1},
        "pous": ({"name": "PLC_PRG", "comment": ""},),
    }


def test_every_kind_makes_objects_with_its_data() -> None:
    for name, kind in kinds().items():
        assert type(make_object(id=new_id(), kind=name, name="x", data={}).data) is kind.data


@pytest.mark.parametrize(
    ("kind", "data", "message"),
    [
        ("task", {"priority": 32}, r"task 'x': priority: .*less than or equal to 31"),
        ("task", {"priority": True}, "priority"),
        ("task", {"interval": "abc"}, r"interval: 'abc' is no time"),
        ("task", {"type": "cyclic", "interval": "T#0ms"}, "needs an interval"),
        ("task", {"watchdog": {"sensitivity": -1}}, r"watchdog\.sensitivity"),
        ("task", {"pous": [{"name": ""}]}, r"pous\.0\.name"),
        ("task", {"color": 1}, "color: Extra inputs are not permitted"),
        ("pou", {"declaration": "a\nb\x00"}, r"declaration: line 2 contains the character U\+0000"),
        ("pou", {"declaration": "\ud800"}, "declaration"),
        ("pou", {"language": "no language"}, "language"),
        ("pou", {"declaration": None}, "declaration"),
        ("device", {"simulated": "yes"}, "simulated"),
        ("folder", {"x": 1}, "x: Extra"),
        ("folder", [], "data"),
    ],
)
def test_wrong_data_is_refused_naming_the_field(kind: str, data: object, message: str) -> None:
    with pytest.raises(InvalidDataError, match=message):
        make_object(id=new_id(), kind=kind, name="x", data=data)


@pytest.mark.parametrize("fields", [{"id": "1"}, {"kind": "../x"}, {"kind": 3}, {"index": -1}, {"other": 1}])
def test_wrong_heads_are_refused(fields: dict[str, object]) -> None:
    with pytest.raises(InvalidDataError):
        make_object(**({"id": new_id(), "kind": "folder", "name": "x", "data": {}} | fields))


def test_line_breaks_become_line_feeds() -> None:
    item = make_object(id=new_id(), kind="gvl", name="GVL", data={"declaration": "a\r\nb\rc"})
    assert item.data.model_dump() == {"declaration": "a\nb\nc"}


def test_an_interval_may_be_a_number_of_microseconds() -> None:
    item = make_object(id=new_id(), kind="task", name="T", data={"interval": 300})
    assert item.data.model_dump()["interval"] == "300"


def test_a_kind_without_plug_in_keeps_its_data() -> None:
    data = {"points": [1, 2.5, {"x": None}], "title": "curve"}
    item = make_object(id=new_id(), kind="oscillogram", name="C", data=data)
    assert isinstance(item.data, UnknownData)
    assert make_object(**json.loads(item.model_dump_json())) == item
    assert item.model_dump(mode="json")["data"] == data


def test_an_object_survives_its_json() -> None:
    for item in new_project("x").walk():
        assert make_object(**json.loads(item.model_dump_json())) == item


def test_subkinds_follow_the_declaration() -> None:
    project = new_project("x")
    (pou,) = project.find_kind("pou")
    assert pou.subkind == "program"
    assert changed_object(pou, data={"declaration": "FUNCTION_BLOCK FB"}).subkind == "function_block"
    assert changed_object(pou, data={"declaration": "?"}).subkind is None


def test_looking_up_what_is_not_there() -> None:
    project = Project("empty")
    assert project.children(None) == []
    assert project.find("a/b") is None
    with pytest.raises(UnknownObjectError, match="'empty' has no object"):
        project.path_of(new_id())
