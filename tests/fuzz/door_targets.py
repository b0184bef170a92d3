"""The sockets of a server and the wire of its soft PLC, with an application that runs.

Each input is a conversation over a connection of its own. After each series the processes live, the
application runs its cycles, somebody else is served at the same door, and memory has not grown beyond bounds.
"""

from __future__ import annotations

import asyncio
import json
import tempfile
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from functools import cache, partial
from pathlib import Path
from typing import Any

import msgpack
from conversations import is_whole, packed, texts, unpacked, wire
from door_client import Door, DoorError, play
from live_server import RUNTIME
from live_team import Team, team
from viser import __version__ as viser_version
from websockets.sync.client import ClientConnection, connect

from tappet.runtime import protocol
from tappet.runtime.client import RuntimeClient
from tappet.runtime.operations.life_cycle import GetInfo, Hello, Reset, Start, Stop
from tappet.runtime.operations.recording import Record
from tappet.runtime.operations.values import Force, Read, Unforce, Write

SERIES = 25
"""Conversations between two looks at the processes."""
GROWTH_MIB = 300
"""What a process may grow by while it is attacked: caches fill, each connection has buffers."""
_open = ExitStack()


class Attacked:
    """The server under attack."""

    def __init__(self, found: Team, folder: Path) -> None:
        self.team = found
        self.frames = 0
        self.conversations = 0
        self.memory = found.memory_mib()
        boss = found.boss
        scene = next(one["id"] for one in boss.get(f"{boss.project}/objects") if one["kind"] == "scene")
        self.view = boss.post(f"{boss.project}/objects/{scene}/view", {})["path"]
        self.program = next(one["id"] for one in boss.get(f"{boss.project}/objects") if one["kind"] == "pou")
        self.runtime_token = (folder / "data" / "runtime" / "token").read_text().strip()

    def door(self, path: str, role: str, **headers: str) -> Door:
        host, _, port = self.team.plant.origin.removeprefix("http://").rpartition(":")
        return Door(host, int(port), path, {"Authorization": f"Bearer {self.team.tokens[role]}", **headers})

    def runtime_door(self) -> Door:
        host, _, port = self.team.boss.state()["url"].removeprefix("ws://").rpartition(":")
        return Door(host, int(port), "/")

    def check(self) -> None:
        """The processes live, the application runs, memory is bounded."""
        self.team.restore()
        self.team.check_running()
        now = self.team.memory_mib()
        if self.conversations <= 2 * SERIES:
            self.memory = {name: max(size, self.memory[name]) for name, size in now.items()}
        grown = {name: size - self.memory[name] for name, size in now.items()}
        assert max(grown.values()) < GROWTH_MIB, f"grown by {grown} MiB"


@cache
def attacked() -> Attacked:
    folder = Path(_open.enter_context(tempfile.TemporaryDirectory()))
    return Attacked(_open.enter_context(team(folder)), folder)


def close() -> None:
    """Ends the server, if there is one."""
    _open.close()
    attacked.cache_clear()


def talk(where: Callable[[], Door], greet: Callable[[], None], data: bytes) -> None:
    """One conversation; the last of a series is followed by a look at everything."""
    world = attacked()
    pieces = unpacked(data)
    try:
        play(where(), wire(pieces), whole=is_whole(pieces))
    except ConnectionError as error:
        raise DoorError(f"the door is shut: {error}") from error
    world.frames += len(pieces)
    world.conversations += 1
    if world.conversations % SERIES == 0:
        world.check()
        greet()


def _url(door: Door) -> str:
    return f"ws://{door.host}:{door.port}{door.path}"


def _other(door: Door, **more: Any) -> ClientConnection:
    return connect(_url(door), additional_headers=door.headers, proxy=None, open_timeout=60, **more)


def _heard(socket: ClientConnection) -> Iterator[str | bytes]:
    while True:
        yield socket.recv(timeout=60)


def _first(socket: ClientConnection, wanted: Callable[[Any], bool]) -> Any:
    return next(m for m in (json.loads(t) for t in _heard(socket) if isinstance(t, str)) if wanted(m))


# -- live values -----------------------------------------------------------------------------------------


def _online_door(role: str = "viewer") -> Door:
    return attacked().door("/api/v1/online?runtime=local", role)


@cache
def _variables() -> list[str]:
    boss = attacked().team.boss
    programs = [one["path"] for one in boss.get(f"{RUNTIME}/symbols")]
    return [v["path"] for name in programs for v in boss.get(f"{RUNTIME}/symbols?path={name}")][:40]


def onlines() -> list[bytes]:
    names = _variables()

    def subscribe(number: int, *paths: str, interval_ms: int = 10) -> dict[str, Any]:
        return {"op": "subscribe", "id": number, "expressions": list(paths), "interval_ms": interval_ms}

    return [
        texts(
            subscribe(1, *names[:3]),
            subscribe(2, *names),
            {"op": "unsubscribe", "id": 1},
            subscribe(1, names[0]),
        ),
        texts(*(subscribe(n, names[n % len(names)], "no.such", interval_ms=10 + n) for n in range(30))),
    ]


def _greet_online() -> None:
    with _other(_online_door("operator")) as socket:
        wish = {"op": "subscribe", "id": 7, "expressions": _variables()[:1], "interval_ms": 50}
        socket.send(json.dumps(wish))
        _first(socket, lambda m: m["op"] == "subscribed")
        next(m for m in _heard(socket) if isinstance(m, bytes))


# -- changes of a project --------------------------------------------------------------------------------


def _events_door(role: str = "viewer") -> Door:
    return attacked().door(f"/api/v1/events?project={attacked().team.project_id}", role)


def events() -> list[bytes]:
    ids = list(attacked().team.boss.ids.values())
    return [texts(*({"op": "open", "object_id": one} for one in [*ids[:8], None, *ids[:4]]))]


def _greet_events() -> None:
    with _other(_events_door("operator")) as socket:
        socket.send(json.dumps({"op": "open", "object_id": "mine"}))
        _first(socket, lambda m: any(u["object_id"] == "mine" for u in m.get("users", ())))


# -- language server -------------------------------------------------------------------------------------


def _lsp_door(role: str = "viewer") -> Door:
    return attacked().door(f"/api/v1/lsp?project={attacked().team.project_id}", role)


def _message(number: int | None, method: str, params: Any) -> dict[str, Any]:
    message = {"jsonrpc": "2.0", "method": method, "params": params}
    return message if number is None else message | {"id": number}


def languages() -> list[bytes]:
    uri = f"tappet:/{attacked().team.project_id}/{attacked().program}/implementation"
    document = {"textDocument": {"uri": uri}}
    at = document | {"position": {"line": 0, "character": 1}}
    opened = {
        "uri": uri,
        "languageId": "iec-st",
        "version": 1,
        "text": "n := n + 1;\nIF x THEN y(); END_IF\n",
    }
    span = {"start": {"line": 0, "character": 0}, "end": {"line": 0, "character": 1}}
    begin = [
        _message(1, "initialize", {"processId": None, "rootUri": None, "capabilities": {}}),
        _message(None, "initialized", {}),
        _message(None, "textDocument/didOpen", {"textDocument": opened}),
    ]
    change = {"textDocument": {"uri": uri, "version": 2}, "contentChanges": [{"range": span, "text": "abc"}]}
    questions = [
        _message(number, f"textDocument/{name}", at | {"context": {"includeDeclaration": True}})
        for number, name in enumerate(
            ("hover", "completion", "definition", "references", "signatureHelp"), 10
        )
    ]
    end = [_message(98, "shutdown", None), _message(None, "exit", None)]
    return [
        texts(*begin, _message(None, "textDocument/didChange", change), *questions, *end),
        texts(
            *begin,
            _message(20, "textDocument/rename", at | {"newName": "m"}),
            _message(21, "workspace/symbol", {"query": "a"}),
            _message(None, "$/cancelRequest", {"id": 21}),
            _message(22, "textDocument/semanticTokens/full", document),
            _message(None, "textDocument/didClose", document),
        ),
    ]


def _greet_lsp() -> None:
    with _other(_lsp_door("operator"), max_size=None) as socket:
        socket.send(json.dumps(_message(1, "initialize", {"processId": None, "capabilities": {}})))
        answer = _first(socket, lambda m: m.get("id") == 1)
        assert "capabilities" in answer["result"], answer


# -- 3D views --------------------------------------------------------------------------------------------

_VISER = f"viser-v{viser_version}"


def _view_door(role: str = "viewer") -> Door:
    return attacked().door(attacked().view, role, **{"Sec-WebSocket-Protocol": _VISER})


def views() -> list[bytes]:
    camera = {
        "type": "ViewerCameraMessage", "wxyz": [1.0, 0.0, 0.0, 0.0], "position": [1.0, 2.0, 3.0], "fov": 1.0,
        "near": 0.1, "far": 100.0, "image_height": 300, "image_width": 400, "look_at": [0.0, 0.0, 0.0],
        "up_direction": [0.0, 0.0, 1.0],
    }  # fmt: skip
    click = {"type": "GuiUpdateMessage", "uuid": "x", "updates": {"value": 1}}
    share = {"type": "ShareUrlRequest"}
    return [packed(("binary", bytes(msgpack.packb(one))) for one in (camera, click, camera, share, camera))]


def _greet_view() -> None:
    door = _view_door("operator")
    headers = {"Authorization": door.headers["Authorization"]}
    with connect(
        _url(door), additional_headers=headers, subprotocols=[_VISER], proxy=None, max_size=None
    ) as socket:  # type: ignore[list-item]
        assert socket.recv(timeout=60)


# -- the wire of the soft PLC ----------------------------------------------------------------------------


def _wire_door() -> Door:
    return attacked().runtime_door()


def wires() -> list[bytes]:
    """Each begins with a good hello, or nothing behind it would be read."""
    hello = Hello(attacked().runtime_token)
    reading = [
        hello,
        GetInfo(),
        Record([(64, 4)], None, 1),
        Read([(0, 8), (64, 4)]),
        Unforce(None),
        GetInfo(),
    ]
    writing = [hello, Write([(64, b"ab", None)]), Force([(72, b"\1", 3)]), Stop(), Reset("warm"), Start()]
    return [
        packed(("binary", protocol.pack_request(number, order)) for number, order in enumerate(orders))
        for orders in (reading, writing)
    ]


def _greet_wire() -> None:
    async def ask() -> None:
        world = attacked()
        async with await RuntimeClient.connect(_url(world.runtime_door()), world.runtime_token) as client:
            assert (await client.call(GetInfo())).state == "run"

    asyncio.run(ask())


DOORS: dict[str, tuple[Callable[[], Door], Callable[[], list[bytes]], Callable[[], None]]] = {
    "door-online": (_online_door, onlines, _greet_online),
    "door-events": (_events_door, events, _greet_events),
    "door-lsp": (_lsp_door, languages, _greet_lsp),
    "door-view": (_view_door, views, _greet_view),
    "door-wire": (_wire_door, wires, _greet_wire),
}
"""Where it is, what is said there, and how somebody else is served, by name of the target."""
TALKS = {name: partial(talk, where, greet) for name, (where, _, greet) in DOORS.items()}


def finish(name: str) -> None:
    """The look after the last series."""
    world = attacked()
    world.check()
    DOORS[name][2]()
    grown = {
        process: f"{size} -> {world.team.memory_mib()[process]} MiB" for process, size in world.memory.items()
    }
    print(f"{name}: {world.conversations} conversations, {world.frames} frames so far, {grown}", flush=True)
