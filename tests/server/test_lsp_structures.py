"""Our structures of the Language Server Protocol beside the ones generated from its specification."""

from __future__ import annotations

import inspect
import json
import re
from enum import IntEnum
from functools import cache
from types import ModuleType
from typing import Any

import msgspec
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from lsp_project import BODY, HEAD, here, start
from lsprotocol import converters
from lsprotocol import types as official
from msgspec import inspect as types

from tappet.server.lsp import questions, session
from tappet.server.lsp.protocol import features, lifecycle, structures, synchronization
from tappet.server.lsp.protocol.structures import Structure

CONVERTER = converters.get_converter()
MODULES = (structures, lifecycle, synchronization, features)
OWN_NAMES = {"Structure", "TextDocumentParams", "TextDocumentContentChangeEvent"}
"""What the specification has no structure for: a base, a common part of params, a union."""
NOT_READ: dict[str, dict[str, Any]] = {
    "InitializeParams": {
        "capabilities": {},
        **dict.fromkeys(("processId", "rootPath", "rootUri", "workspaceFolders")),
    },
    "CodeActionParams": {"context": {"diagnostics": []}},
}
"""What clients must send and the server does not read."""
METHODS = {**session._REQUESTS, **session._NOTIFICATIONS}
JSON = st.recursive(
    st.booleans() | st.integers(-(2**40), 2**40) | st.text(max_size=5),
    lambda inner: st.lists(inner, max_size=2) | st.dictionaries(st.text(max_size=3), inner, max_size=2),
    max_leaves=4,
)


def declared(module: ModuleType, kind: type) -> list[Any]:
    found = [item for _, item in inspect.getmembers(module, inspect.isclass)]
    return [item for item in found if issubclass(item, kind) and item.__module__ == module.__name__]


STRUCTURES = [item for module in MODULES for item in declared(module, Structure)]
ENUMS = [item for module in MODULES for item in declared(module, IntEnum)]
PAIRS = [
    (item, getattr(official, item.__name__)) for item in STRUCTURES if item.__name__ not in OWN_NAMES
] + [
    (kind, official.METHOD_TO_TYPES[method][2])
    for method, (kind, _) in METHODS.items()
    if kind is not None and not method.startswith("tappet/")
]


@cache
def values(kind: type) -> st.SearchStrategy[Any]:
    """Values of one of our structures."""
    return st.deferred(lambda: of_type(types.type_info(kind)))


def of_type(info: types.Type) -> st.SearchStrategy[Any]:
    match info:
        case types.StructType(cls, fields):
            return st.builds(cls, **{field.name: field_values(field.type) for field in fields})
        case _:
            return field_values(info)


def field_values(info: types.Type) -> st.SearchStrategy[Any]:
    match info:
        case types.StructType(cls):
            return values(cls)
        case types.IntType():
            assert info.ge is not None
            assert info.le is not None
            return st.integers(info.ge, info.le)
        case types.StrType():
            return st.text(max_size=5)
        case types.BoolType():
            return st.booleans()
        case types.NoneType():
            return st.none()
        case types.LiteralType(options):
            return st.sampled_from(options)
        case types.EnumType(cls):
            return st.sampled_from(list(cls))
        case types.ListType(item):
            return st.lists(field_values(item), max_size=2)
        case types.TupleType(items):
            return st.tuples(*map(field_values, items))
        case types.DictType(_, item):
            return st.dictionaries(st.text(max_size=5), field_values(item), max_size=2)
        case types.UnionType(options):
            return st.one_of(*map(field_values, options))
        case types.AnyType():
            return st.none() | JSON
    raise AssertionError(info)


@pytest.mark.parametrize(
    ("ours", "theirs"), PAIRS, ids=lambda kind: kind.__name__ if isinstance(kind, type) else None
)
@settings(max_examples=30, deadline=None)
@given(data=st.data())
def test_structures_are_those_of_the_specification(
    ours: type[Structure], theirs: type, data: st.DataObject
) -> None:
    value = data.draw(values(ours))
    plain = json.loads(msgspec.json.encode(value))
    sent = plain | NOT_READ.get(theirs.__name__, {})
    back = CONVERTER.unstructure(CONVERTER.structure(sent, theirs))
    assert back == sent
    assert msgspec.json.decode(json.dumps(back), type=ours) == value


@pytest.mark.parametrize("kind", ENUMS, ids=lambda kind: kind.__name__)
def test_numbers_are_those_of_the_specification(kind: type[IntEnum]) -> None:
    expected = {
        re.sub(r"(?<=[a-z])(?=[A-Z])", "_", item.name).upper().rstrip("_"): item.value
        for item in getattr(official, kind.__name__)
    }
    assert {item.name: item.value for item in kind} == expected


def test_methods_are_those_of_the_specification() -> None:
    for methods, answered in ((session._REQUESTS, True), (session._NOTIFICATIONS, False)):
        for method in methods:
            if not method.startswith("tappet/"):
                assert (official.METHOD_TO_TYPES[method][1] is not None) is answered, method


async def test_answers_are_those_of_the_specification() -> None:
    """Every request once, and published messages with all that they can have."""
    asked = {"initialize"}
    async with start() as client:

        def check(method: str, answer: Any) -> None:
            kind = official.METHOD_TO_TYPES[method][1]
            assert CONVERTER.unstructure(CONVERTER.structure(answer, kind)) == answer, method

        begin = {"processId": None, "rootUri": None, "capabilities": {}}
        check("initialize", await client.answer("initialize", begin))
        await client.notify("initialized", {})
        declared = "iCount : INT; (* how *many* *)\nICOUNT : INT;\nmotor : FB_Motor;"
        await client.open(HEAD, f"PROGRAM PLC_PRG\nVAR\n{declared}\nEND_VAR")
        at = await client.open(BODY, "IF TRUE THEN\nmot|or(xOn := iCount > 5);\nEND_IF\nxNew := TRUE;")
        for document in (HEAD, BODY):
            params = {"uri": document, "diagnostics": await client.published(document)}
            kind = official.PublishDiagnosticsParams
            assert params["diagnostics"]
            assert CONVERTER.unstructure(CONVERTER.structure(params, kind)) == params
        more: dict[str, Any] = {
            "references": {"context": {"includeDeclaration": True}},
            "rename": {"newName": "drive"},
            "signatureHelp": {"position": {"line": 1, "character": 13}},
            "codeAction": {"range": here(3, 0, 4), "context": {"diagnostics": []}},
            "formatting": {"options": {"tabSize": 2, "insertSpaces": True}},
        }
        for method in questions.QUESTIONS:
            if method.startswith("textDocument/"):
                answer = await client.answer(method, at | more.get(method.partition("/")[2], {}))
                assert answer.get("result") or method.endswith("implementation"), answer
                check(method, answer)
                asked.add(method)
        for method, params in (("workspace/symbol", {"query": "motor"}), ("shutdown", None)):
            answer = await client.answer(method, params)
            check(method, answer)
            asked.add(method)
        assert answer == {"jsonrpc": "2.0", "id": client.next_id, "result": None}
    assert asked == {method for method in session._REQUESTS if not method.startswith("tappet/")}
