"""What the server says of a project that holds every kind: what may be added, moved and copied where, under
which name. The tests of the front end hold its own look into the table of places against it.
"""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

from tappet.iec.words import KEYWORDS, RESERVED
from tappet.project import edit
from tappet.project.errors import InvalidNameError, NameTakenError, NotPlaceableError
from tappet.project.kind_registry import kinds
from tappet.project.model import DEVICE, Project
from tappet.project.new_project import new_project
from tappet.project.placement import Site, check_name, placement_rules

ANSWERS = Path(__file__).parents[2] / "frontend/src/project/placement.json"

NAMES = [
    "", "Motor", "_motor", "PRG", "prg", "Nested", "NESTED", "Folder", "Shared", "1st", "a__b", "a b", " a",
    "a ", "a.b", "a/b", "a\\b", "ä", "Get", "Set", "LD", "ST", "R", "BIT", "NULL", "GVL", "TON", "D1",
    *sorted(RESERVED | KEYWORDS),
]  # fmt: skip


def every_kind() -> Project:
    """A project with every kind, below what it can be below: subkinds, nested folders, full places."""
    project = new_project("Places")

    def add(parent: str | None, kind: str, name: str, **fields: Any) -> str:
        nonlocal project
        project, item = edit.add_object(project, parent, kind, name, **fields)
        return item.id

    def drop(kind: str, below: str) -> None:
        nonlocal project
        (gone,) = (item for item in project.children(below) if item.kind == kind)
        project = edit.delete_object(project, gone.id)

    (application,) = project.applications()
    for place, suffix in ((application.id, ""), (None, "Shared")):
        folder = add(place, "folder", f"Folder{suffix}")
        nested = add(folder, "folder", "Inner")
        block = add(nested, "pou", f"Nested{suffix}", subkind="function_block")
        add(place, "pou", f"PRG{suffix}", subkind="program")
        add(place, "pou", f"FUN{suffix}", subkind="function")
        add(place, "pou", f"Unsaid{suffix}", data={"declaration": ""})
        add(place, "pou", f"Odd{suffix}", data={"declaration": "VAR_GLOBAL END_VAR"})
        add(folder, "dut", f"DUT{suffix}")
        add(place, "gvl", f"GVL{suffix}")
        interface = add(folder, "interface", f"ITF{suffix}")
        members = add(block, "folder", "Members")
        for owner in (block, members, interface):
            add(owner, "method", "Home" if owner == members else "Start")
        add(members, "action", "Act")
        add(interface, "property", "Both")
        single = add(members, "property", "Single")
        (second,) = (item for item in project.children(single) if item.name == "Set")
        project = edit.delete_object(project, second.id)
    add(application.id, "persistent", "Kept")
    add(application.id, "scene", "Scene")
    add(application.id, "trace", "Trace")
    add(application.id, "flight_recording", "Monday")
    pool = add(application.id, "axis_pool", "SoftMotion General Axis Pool")
    add(pool, "axis", "Axis")
    add(application.id, "cam", "Cam")
    add(application.id, "axis_group", "Group")
    add(application.id, "cnc", "Path")
    manager = add(application.id, "recipe_manager", "Recipe Manager")
    add(manager, "recipe_definition", "Recipes")
    add(None, "script", "Script")
    add(None, "page_setup", "Page Setup")
    inner = add(application.id, "application", "Second")
    drop("library_manager", inner)
    drop("task_configuration", inner)
    add(None, DEVICE, "D1")
    missing = set(kinds()) - {item.kind for item in project.walk()}
    assert not missing, f"add an object of {missing}"
    return project


def _said(project: Project, act: Callable[..., object], moved: str, parent: str | None) -> str:
    """`yes`, `no`, or `taken` where only the name is in the way."""
    try:
        act(project, moved, parent)
    except NotPlaceableError:
        return "no"
    except NameTakenError:
        return "taken"
    return "yes"


def answers() -> str:
    """The table, the objects and what the server says, as JSON; ids count up."""
    project = every_kind()
    short = {item.id: f"o{number}" for number, item in enumerate(project.walk())}
    parents = [None, *short]
    objects = [
        {
            "id": short[item.id],
            "parent_id": short.get(item.parent_id or ""),
            "kind": item.kind,
            "subkind": item.subkind,
            "name": item.name,
            "index": item.index,
            "revision": 1,
            "excluded": False,
        }
        for item in project.walk()
    ]
    offered: dict[str, dict[str, str]] = {}
    for parent in parents:
        for kind in kinds():
            try:
                _, added = edit.add_object(project, parent, kind)
            except (NotPlaceableError, NameTakenError):
                continue
            root = "devices" if kind == DEVICE else "pous"
            offered.setdefault(short[parent] if parent else root, {})[kind] = added.name
    dropped: dict[str, dict[str, dict[str, list[str | None]]]] = {}
    for act in (edit.move_object, edit.copy_object):
        of = dropped[act.__name__.removesuffix("_object")] = {}
        for item in project.walk():
            said = of[short[item.id]] = {"yes": [], "taken": []}
            for parent in parents:
                said.setdefault(_said(project, act, item.id, parent), []).append(short.get(parent or ""))
            del said["no"]
    places = [("pou", "application"), ("folder", "application"), ("method", "interface"), ("device", None)]
    named = []
    for kind, owner in places:
        parent = next((item.id for item in project.walk() if item.kind == owner), None)
        good = []
        for name in NAMES:
            try:
                check_name(Site.of(project, parent), kind, name)
            except (InvalidNameError, NameTakenError):
                continue
            good.append(name)
        named.append({"kind": kind, "parent": short.get(parent or ""), "good": good})
    rules = [rule.model_dump(mode="json") for rule in placement_rules()]
    tables = {
        "rules": rules, "objects": objects, "offered": offered, **dropped, "names": [NAMES], "named": named,
    }  # fmt: skip
    return "{\n" + ",\n".join(f"{json.dumps(key)}: {_rows(value)}" for key, value in tables.items()) + "\n}\n"


def _rows(value: Any) -> str:
    """One line an entry, so that a diff reads well."""
    if isinstance(value, dict):
        return (
            "{\n"
            + ",\n".join(f"{json.dumps(key)}: {json.dumps(item)}" for key, item in value.items())
            + "\n}"
        )
    return "[\n" + ",\n".join(json.dumps(item) for item in value) + "\n]"


if __name__ == "__main__":
    ANSWERS.write_text(answers(), encoding="utf-8")
