"""A drawn language from an installed package, from the dialog over files, messages and cross references to a
running program and its exception, all at elements. The package is the example of docs/extending.md."""

from __future__ import annotations

import io
import json
import os
import re
import time
import zipfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from fastapi import FastAPI
from fastapi.testclient import TestClient
from tests.plugins.installing import installed

from tappet.codegen.build import BuildSession, build_application
from tappet.codegen.debug_build import instrument
from tappet.codegen.package import CodePackage
from tappet.iec.languages import file_ending, languages
from tappet.lang.services import cross_references, rename
from tappet.lang.services.results import ServiceError
from tappet.lang.services.workspace import Workspace
from tappet.project import edit
from tappet.project.folder import decode, encode
from tappet.project.model import Project
from tappet.project.new_project import new_project
from tappet.project.sources import application_sources
from tappet.runtime.debugger.shapes import BreakpointOrder, Spot
from tappet.runtime.local import ApplicationException, LocalRuntime
from tappet.runtime.plc import SoftPlc
from tappet.server.lsp.project_programs import ProjectPrograms, part_uri

API = "/api/v1"
DECLARATION = """PROGRAM PLC_PRG
VAR
    a : DINT := 2; b : DINT := 3; sum : DINT; quotient : DINT; divisor : DINT := 2; isMore : BOOL;
END_VAR"""
CHAIN: dict[str, Any] = {
    "chain": [
        {"id": "n1", "op": "ADD", "in": ["a", "b"], "out": "sum", "x": 10, "y": 20},
        {"id": "n2", "op": "DIV", "in": ["sum * 4", "divisor"], "out": "quotient"},
        {"id": "n3", "op": "GT", "in": ["quotient", "a + b"], "out": "isMore"},
        {"id": "n4", "op": "ST", "text": "IF isMore THEN\n    a := a + 1;\nEND_IF"},
    ]
}


@pytest.fixture
def chain(tmp_path: Path) -> Iterator[list[str]]:
    with installed("toy_language", tmp_path / "site") as paths:
        yield paths


def drawn(body: dict[str, Any] | str = CHAIN, declaration: str = DECLARATION) -> Project:
    """A project whose program is drawn."""
    project = new_project("Chains")
    (program,) = project.find_kind("pou")
    text = body if isinstance(body, str) else json.dumps(body, indent=2)
    data = {"declaration": declaration, "implementation": text, "language": "CHAIN"}
    return edit.change_data(project, program.id, data)


def with_element(number: int, **values: Any) -> dict[str, Any]:
    body = json.loads(json.dumps(CHAIN))
    body["chain"][number] |= values
    return body


def build(project: Project) -> Any:
    (application,) = project.applications()
    return build_application(application_sources(project, application.id))


def messages(body: dict[str, Any] | str) -> list[tuple[str, str | None]]:
    return [(d.code, d.element) for d in build(drawn(body)).diagnostics]


def workspace(project: Project) -> tuple[Workspace, str]:
    (program,) = project.find_kind("pou")
    return Workspace(ProjectPrograms("p", lambda: project)), part_uri("p", program.id, "implementation")


def test_offered_made_and_exported_over_rest(admin: TestClient, chain: list[str]) -> None:
    rules = {rule["kind"]: rule["languages"] for rule in admin.get(f"{API}/placement").json()}
    assert rules["pou"] == rules["action"] == rules["method"] == ["ST", "IL", "CHAIN"]
    project = f"{API}/projects/{admin.post(f'{API}/projects', json={'name': 'Chains'}).json()['id']}"
    tree = {item["kind"]: item["id"] for item in admin.get(f"{project}/objects").json()}
    order = {"parent_id": tree["application"], "kind": "pou", "name": "Drawn", "language": "CHAIN"}
    made = admin.post(f"{project}/objects", json=order)
    assert made.status_code == 201, made.text
    item = made.json()
    assert item["data"]["language"] == "CHAIN"
    data = {**item["data"], "implementation": json.dumps(CHAIN)}
    saved = admin.put(f"{project}/objects/{item['id']}", json={"base_revision": 1, "data": data})
    assert saved.status_code == 200, saved.text
    with zipfile.ZipFile(io.BytesIO(admin.get(f"{project}/export").content)) as held:
        (name,) = [name for name in held.namelist() if name.endswith("Drawn.chain")]
        assert json.loads(held.read(name)) == CHAIN


def test_folder_keeps_the_drawing_in_a_file_of_its_own(chain: list[str]) -> None:
    project = drawn()
    files = encode(project)
    place = "Devices/Tappet Soft PLC/PLC Logic/Application/PLC_PRG"
    assert json.loads(files[f"{place}.chain"]) == CHAIN
    assert files[f"{place}.st"].decode() == f"{DECLARATION}\nEND_PROGRAM\n"
    again = decode(files).project
    assert again.find_kind("pou")[0].data == project.find_kind("pou")[0].data
    assert encode(again) == files


def test_without_the_package_the_drawing_is_kept(tmp_path: Path) -> None:
    with installed("toy_language", tmp_path / "site"):
        project = drawn()
        files = encode(project)
    assert "CHAIN" not in languages()
    assert file_ending("CHAIN", "{}") == "chain"
    again = decode(files).project
    assert encode(again) == files
    (message,) = [d for d in build(again).diagnostics if d.severity == "error"]
    assert "is in CHAIN, which cannot be compiled yet" in message.message


def test_it_runs_with_the_values_that_are_drawn(chain: list[str]) -> None:
    result = build(drawn())
    assert result.diagnostics == []
    with LocalRuntime(result.package, virtual=True) as runtime:
        runtime.run(2)
        names = ("sum", "quotient", "isMore", "a")
        assert [runtime.literal(f"PLC_PRG.{name}") for name in names] == ["6", "12", "TRUE", "4"]


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        (with_element(1, out="quotent"), [("E0201", "n2")]),
        (with_element(0, **{"in": ["a", "b +"]}), [("E0104", "n1")]),
        (with_element(0, **{"in": ["a b", "b"]}), [("E0101", "n1")]),
        (with_element(0, **{"in": ["a"]}), [("E0132", "n1")]),
        (with_element(2, out=""), [("E0132", "n3")]),
        (with_element(2, op="NAND"), [("E0132", "n3")]),
        (with_element(2, id="n1"), [("E0131", "n1")]),
        (with_element(3, text="a := 1;\nb := TRUE;\nc := 1;"), [("E0301", "n4"), ("E0201", "n4")]),
        ("{not json", [("E0130", None)]),
        ("[1, 2]", [("E0130", None)]),
        ('{"chain": [' * 3, [("E0130", None)]),
        ("", []),
        ("{}", []),
    ],
)
def test_messages_name_the_element(
    chain: list[str], body: dict[str, Any] | str, expected: list[tuple[str, str | None]]
) -> None:
    assert sorted(messages(body), key=str) == sorted(expected, key=str)


def test_a_message_stands_where_the_name_is(chain: list[str]) -> None:
    """In the listing, and in the record for machines."""
    (found,) = build(drawn(with_element(1, **{"in": ["sum * facter", "divisor"]}))).diagnostics
    line = found.record()["line"]
    assert (found.element, line) == ("n2", 6)
    assert str(found).startswith("PLC_PRG:6:18: error E0201: Element n2: ")


def test_server_tells_the_element(app: FastAPI, admin: TestClient, chain: list[str]) -> None:
    store = app.state.services.store
    info = store.create_project("Chains", "ann")
    (program,) = store.load(info.id).find_kind("pou")
    data = drawn(with_element(1, out="quotent")).find_kind("pou")[0].data.model_dump()
    store.save(info.id, program.id, program.revision, data, "ann")
    (application,) = store.load(info.id).applications()
    os.environ["PYTHONPATH"] = os.pathsep.join([*chain, os.environ.get("PYTHONPATH", "")])
    try:
        report = admin.post(f"{API}/projects/{info.id}/applications/{application.id}/build").json()
    finally:
        os.environ["PYTHONPATH"] = os.environ["PYTHONPATH"].split(os.pathsep, len(chain))[-1]
    (message,) = report["diagnostics"]
    assert (message["code"], message["object_id"], message["part"]) == ("E0201", program.id, "implementation")
    assert message["element"] == "n2"


@pytest.mark.parametrize(("value", "element"), [("divisor := 0", "n2"), ("divisor := 1", None)])
def test_a_fault_names_the_element(chain: list[str], value: str, element: str | None) -> None:
    declaration = re.sub(r"divisor : DINT := 2", value.replace(":=", ": DINT :="), DECLARATION)
    result = build(drawn(declaration=declaration))
    package = CodePackage.from_bytes(result.package.to_bytes())
    assert package.source_maps == result.package.source_maps
    with LocalRuntime(package, virtual=True) as runtime:
        if element is None:
            runtime.run(1)
            return
        with pytest.raises(ApplicationException, match="division by zero in PLC_PRG, element n2") as caught:
            runtime.run(1)
    report = caught.value.report
    assert tuple(at.place and at.place.element for at in (report, report.call_stack[0])) == (element, element)


def test_cross_references_list_elements(chain: list[str]) -> None:
    space, document = workspace(drawn())
    (snapshot,) = space.snapshots()
    found = cross_references.cross_references_of(snapshot, "PLC_PRG.sum")
    places = [(item.place.part, item.place.element, item.role) for item in found]
    assert places == [
        ("declaration", None, "declaration"),
        ("implementation", "n1", "write"),
        ("implementation", "n2", "read"),
    ]
    assert {item.place.document for item in found} == {
        document,
        document.replace("implementation", "declaration"),
    }
    texts = [item.place for item in cross_references.cross_references_of(snapshot, "PLC_PRG.a")]
    assert [place.element for place in texts] == [None, "n1", "n3", "n4", "n4"]


def test_renaming_what_a_drawing_uses_is_refused_with_the_element(chain: list[str]) -> None:
    space, _ = workspace(drawn())
    (snapshot,) = space.snapshots()
    (place,) = [
        item.place
        for item in cross_references.cross_references_of(snapshot, "PLC_PRG.sum")
        if item.role == "declaration"
    ]
    with pytest.raises(ServiceError, match="element n1"):
        rename.rename(snapshot, place.document, cross_references.Position(*place.span[:2]), "total")


def test_an_edit_of_an_element_is_checked_like_an_edit_of_a_body(chain: list[str]) -> None:
    space, document = workspace(drawn())
    space.snapshots()
    analysed = space.whole_analyses
    space.open(document, json.dumps(with_element(1, out="quotent")))
    (snapshot,) = space.snapshots()
    assert [d.code for d in snapshot.diagnostics] == ["E0201"]
    assert space.whole_analyses == analysed


def test_a_breakpoint_halts_before_each_element(chain: list[str]) -> None:
    """Each is named by its id, and what the ones before it compute is there."""
    project = drawn()
    (application,), (program,) = project.applications(), project.find_kind("pou")
    session = BuildSession()
    result = build_application(application_sources(project, application.id), session=session)
    assert result.package is not None
    assert session.generated is not None
    plc = SoftPlc(None)
    try:
        plc.load(CodePackage.from_bytes(result.package.to_bytes()))
        plc.debugger.load(instrument(session.generated).to_bytes())
        for element in ("n1", "n2", "n3", "n4"):
            place = Spot(program.id, element=element)
            assert plc.debugger.add(BreakpointOrder(place=place)).verified
        assert not plc.debugger.add(BreakpointOrder(place=Spot(program.id, element="n9"))).verified
        plc.start()
        seen = []
        for command in ("continue", "step_over", "step_over", "continue"):
            end = time.monotonic() + 20
            while not plc.debugger.halted_tasks():
                assert time.monotonic() < end, "it does not halt"
                time.sleep(0.001)
            (halt,) = plc.debugger.state().halted
            values = {v.name: v.literal for v in plc.debugger.variables(halt.task, 0).variables}
            seen.append((halt.place.element, values["sum"], values["quotient"], values["isMore"]))
            assert halt.place.object_id == program.id
            plc.debugger.control(command)
        assert seen == [
            ("n1", "0", "0", "FALSE"),
            ("n2", "5", "0", "FALSE"),
            ("n3", "5", "10", "FALSE"),
            ("n4", "5", "10", "TRUE"),
        ]
    finally:
        plc.close()
