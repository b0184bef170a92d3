"""An operation of another package, found by its entry point: wire, client, REST and API document."""

from __future__ import annotations

import ast
import asyncio
import sys
import types
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from fake_plc import FakePlc
from fastapi import FastAPI
from fastapi.testclient import TestClient
from server_clients import ROLES

from tappet.codegen.build import build_application
from tappet.lang.source import Source
from tappet.runtime.client import RuntimeClient, RuntimeRefused
from tappet.runtime.operations import registry
from tappet.runtime.operations.declaration import Operation, SessionOperation
from tappet.runtime.plc import SoftPlc
from tappet.runtime.service import RuntimeService
from tappet.server import openapi
from tappet.server.app import create_app
from tappet.server.settings import ServerSettings

PACKAGE = Path(__file__).parent / "toy_operation"
BACKEND = Path(registry.__file__).parents[2]
TOKEN = "a token of the tests, long enough"
TEXT = "PROGRAM PLC_PRG\nVAR n : INT := 5; full : INT := 32760; END_VAR\nEND_PROGRAM"


@pytest.fixture(autouse=True)
def toy(monkeypatch: pytest.MonkeyPatch) -> Iterator[Any]:
    """The package is installed, as long as a test runs."""
    monkeypatch.syspath_prepend(str(PACKAGE))
    registry.known.cache_clear()
    yield registry.known()["toy_nudge"]
    registry.known.cache_clear()
    sys.modules.pop("toy_operation", None)


def test_over_the_wire(toy: Any) -> None:
    async def scenario() -> None:
        plc = SoftPlc(None)
        package = build_application([Source("a.st", TEXT)]).package
        assert package is not None
        plc.load(package)
        service = RuntimeService(plc, TOKEN)
        port = await service.start("127.0.0.1", 0)
        try:
            async with await RuntimeClient.connect(f"ws://127.0.0.1:{port}", TOKEN) as client:
                n = (await client.symbols()).resolve("PLC_PRG.n")
                assert (await client.call(toy(n.offset, 7))).value == 12
                with pytest.raises(RuntimeRefused, match="toy_nudge: 'by': expected 'int' <= 100") as wrong:
                    await client.call(toy(n.offset, 101))
                assert wrong.value.code == "bad_request"
                full = (await client.symbols()).resolve("PLC_PRG.full")
                with pytest.raises(RuntimeRefused, match="32860 is no INT") as refused:
                    await client.call(toy(full.offset, 100))
                assert refused.value.code == "toy_overflow"
        finally:
            await service.close()
            plc.close()

    asyncio.run(scenario())


def test_over_rest(app: FastAPI, as_role: dict[str, TestClient], runtime_id: str, plc: FakePlc) -> None:
    url = f"/api/v1/runtimes/{runtime_id}/toy/2/nudge"
    plc.set("PLC_PRG.nCount", 5)
    for role in ROLES[: ROLES.index("engineer")]:
        answer = as_role[role].post(url, json={"by": 7})
        assert (answer.status_code, answer.json()["required_role"]) == (403, "engineer")
    answer = as_role["engineer"].post(url, json={"by": 7})
    assert (answer.status_code, answer.json()) == (200, {"value": 12})
    assert plc.forced == {(2, None): b"\x0c\x00"}
    entry = as_role["admin"].get("/api/v1/audit").json()[0]
    kept = {name: entry[name] for name in ("action", "subject", "new_value", "runtime_id", "username")}
    assert kept == {
        "action": "toy-nudge",
        "subject": "offset 2",
        "new_value": "7",
        "runtime_id": runtime_id,
        "username": entry["username"],
    }


@pytest.mark.parametrize(
    ("path", "body", "detail"),
    [
        ("2", {"by": 101}, "body.by: expected 'int' <= 100"),
        ("2", {"by": "7"}, "body.by: expected 'int', got 'str'"),
        ("2", {}, "body: object missing required field 'by'"),
        ("2", {"by": 1, "offset": 3}, "body.offset: stands in the path, not here"),
        ("2", {"by": 1, "to": 3}, "body: object contains unknown field 'to'"),
        ("2", [1], "body: expected 'object', got 'array'"),
        ("minus", {"by": 1}, "path.offset: expected 'int', got 'str'"),
        ("-1", {"by": 1}, "path.offset: expected 'int' >= 0"),
    ],
)
def test_a_wrong_field_is_named(
    as_role: dict[str, TestClient], runtime_id: str, path: str, body: object, detail: str
) -> None:
    answer = as_role["engineer"].post(f"/api/v1/runtimes/{runtime_id}/toy/{path}/nudge", json=body)
    problem = answer.json()
    assert (answer.status_code, problem["type"]) == (422, "urn:tappet:problem:invalid-request")
    assert problem["detail"] == detail
    location, _, message = detail.partition(": ")
    assert problem["errors"] == [{"location": location, "message": message}]
    assert as_role["admin"].get("/api/v1/audit").json()[0]["action"] != "toy-nudge"


def test_its_own_refusal_is_a_problem_and_a_refused_act(
    as_role: dict[str, TestClient], runtime_id: str, plc: FakePlc
) -> None:
    plc.set("PLC_PRG.nCount", 32_760)
    answer = as_role["engineer"].post(f"/api/v1/runtimes/{runtime_id}/toy/2/nudge", json={"by": 100})
    assert answer.status_code == 409
    assert answer.json()["detail"] == "'test stand' refused: 32860 is no INT"
    entry = as_role["admin"].get("/api/v1/audit").json()[0]
    assert (entry["action"], entry["result"]) == ("toy-nudge", "refused")
    assert entry["reason"] == answer.json()["detail"]


def test_no_such_route_without_the_runtime(as_role: dict[str, TestClient]) -> None:
    answer = as_role["engineer"].post("/api/v1/runtimes/x/toy/2/nudge", json={"by": 1})
    assert answer.json()["detail"] == "There is no runtime 'x'."


def test_the_document_lists_it() -> None:
    document = openapi.document(create_app(ServerSettings(), FakePlc().connect))
    operation = document["paths"]["/api/v1/runtimes/{runtime_id}/toy/{offset}/nudge"]["post"]
    assert operation["description"] == "Add to the INT at a place of the image."
    assert {p["name"] for p in operation["parameters"]} == {"runtime_id", "offset"}
    body = operation["requestBody"]["content"]["application/json"]["schema"]
    assert body == {"$ref": "#/components/schemas/Nudge"}
    shape = document["components"]["schemas"]["Nudge"]
    assert shape["properties"]["by"] | {"minimum": -100, "maximum": 100} == shape["properties"]["by"]
    assert list(shape["properties"]) == ["by"]
    reply = operation["responses"]["200"]["content"]["application/json"]["schema"]
    assert reply == {"$ref": "#/components/schemas/Nudged"}


def test_two_operations_of_one_name_are_refused(toy: Any) -> None:
    module = type(sys)("another")
    module.Nudge = type("Nudge", (toy,), {"__module__": "another"})
    with pytest.raises(registry.RegistrationError, match="'toy_nudge' is declared twice: in toy_operation"):
        registry.collect([sys.modules["toy_operation"], module])


@pytest.mark.parametrize(("base", "handler"), [(Operation, "run"), (SessionOperation, "serve")])
def test_an_operation_without_handler_is_refused(base: Any, handler: str) -> None:
    module = type(sys)("another")
    own = {"__module__": "another", "op": "toy_idle"}
    module.Idle = types.new_class("Idle", (base[int],), exec_body=lambda body: body.update(own))
    message = f"'toy_idle' has no handler: another.Idle does not define '{handler}'"
    with pytest.raises(registry.RegistrationError, match=message):
        registry.collect([module])


def test_nothing_else_lists_operations() -> None:
    """No literal of the shipped code names several operations: a new one would have to be added to it."""
    known = registry.known()
    classes = {kind.__name__ for kind in known.values()}
    lists = []
    for path in BACKEND.rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            items: list[Any] = []
            if isinstance(node, ast.List | ast.Tuple | ast.Set):
                items = node.elts
            elif isinstance(node, ast.Dict):
                items = [*node.keys, *node.values]
            named = {item.value for item in items if isinstance(item, ast.Constant)} & known.keys()
            types = {item.id for item in items if isinstance(item, ast.Name)} & classes
            if len(named) > 2 or len(types) > 2:
                lists.append(f"{path.relative_to(BACKEND)}:{node.lineno}")
    assert lists == []
