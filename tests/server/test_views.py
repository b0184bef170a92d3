"""3D views behind the server's login, with a real viser server."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
import viser
from fastapi import FastAPI
from fastapi.testclient import TestClient
from server_clients import SOCKETS, bare
from starlette.testclient import WebSocketDenialResponse
from viser._messages import ShareUrlRequest
from viser.infra import ClientId

from tappet.server.problems import Problem
from tappet.server.services import Services
from tappet.server.views.private_viser import PrivateViser
from tappet.server.views.service import MOST_VIEWS, ViewRegistry

PROTOCOL = f"viser-v{viser.__version__}"


def scene() -> PrivateViser:
    server = PrivateViser()
    server.scene.add_box("/bottle", color=(1, 2, 3), dimensions=(1.0, 1.0, 1.0))
    return server


@pytest.fixture
def view(app: FastAPI, services: Services) -> str:
    app.state.portal.call(services.views.start_view, "plant", scene)
    return "/views/plant/"


def test_page_comes_through_with_its_own_policy(admin: TestClient, view: str) -> None:
    page = admin.get(view)
    assert page.status_code == 200
    assert "<title>Viser</title>" in page.text
    assert "frame-ancestors 'self'" in page.headers["content-security-policy"]
    assert admin.get("/views/plant", follow_redirects=False).headers["location"] == "/views/plant/"
    assert admin.get(view + "nothing.js").status_code == 404
    assert admin.get("/views/other/").status_code == 404


@pytest.mark.parametrize("path", ["/views/plant", "/views/plant/"])
def test_scene_comes_through_the_socket(admin: TestClient, view: str, path: str) -> None:
    """viser's page asks without the slash (it strips it from its own address)."""
    with admin.websocket_connect(SOCKETS + path, subprotocols=[PROTOCOL]) as socket:
        assert socket.accepted_subprotocol == PROTOCOL
        assert len(socket.receive_bytes()) > 0


def test_strangers_and_foreign_pages_see_nothing(app: FastAPI, admin: TestClient, view: str) -> None:
    assert bare(app).get(view).status_code == 401
    foreign = bare(app, headers={"Origin": "http://evil.example"})
    foreign.cookies.set("tappet_session", admin.cookies["tappet_session"])
    for client, status in ((bare(app), 401), (foreign, 403)):
        with (
            pytest.raises(WebSocketDenialResponse) as refused,
            client.websocket_connect(SOCKETS + view, subprotocols=[PROTOCOL]),
        ):
            pass
        assert refused.value.status_code == status


def _listening() -> set[str]:
    """TCP sockets on which this process takes connections."""
    mine = {os.readlink(entry.path) for entry in os.scandir("/proc/self/fd") if Path(entry.path).is_symlink()}
    found = set()
    for table in ("tcp", "tcp6"):
        for line in Path("/proc/self/net", table).read_text().splitlines()[1:]:
            words = line.split()
            if words[3] == "0A" and f"socket:[{words[9]}]" in mine:
                found.add(words[1])
    return found


def test_no_port_is_open_beside_the_server(app: FastAPI, services: Services) -> None:
    """A page of another site could read the scene from viser's own port, and so could other users."""
    before = _listening()
    server: PrivateViser = app.state.portal.call(services.views.start_view, "plant", scene)
    assert _listening() == before
    assert server.socket.is_socket()
    assert server.socket.parent.stat().st_mode & 0o777 == 0o700
    app.state.portal.call(services.views.stop_view, "plant")
    assert not server.socket.parent.exists()


def test_a_browser_cannot_make_the_scene_public(app: FastAPI, services: Services) -> None:
    server: PrivateViser = app.state.portal.call(services.views.start_view, "plant", scene)
    handlers = server._websock_server._incoming_handlers[ShareUrlRequest]
    for handler in handlers:
        handler(ClientId(0), ShareUrlRequest())
    assert server.request_share_url() is None
    assert server._share_tunnel is None


def test_traversal_stays_inside(admin: TestClient, view: str) -> None:
    for path in ("..%2f..%2f..%2fetc%2fpasswd", "%2e%2e/%2e%2e/etc/passwd", "..%5c..%5csecret"):
        answer = admin.get(view + path)
        assert answer.status_code == 404, path
        assert "root:" not in answer.text


class Dummy:
    def __init__(self) -> None:
        self.stopped = False

    @property
    def socket(self) -> Path:
        return Path("/nowhere")

    def stop(self) -> None:
        self.stopped = True


async def test_a_view_is_started_once_and_the_oldest_idle_one_makes_room() -> None:
    views = ViewRegistry()
    made: list[Dummy] = []

    def make() -> Dummy:
        made.append(Dummy())
        return made[-1]

    first = await views.start_view("0", make)
    assert await views.start_view("0", make) is first
    for n in range(1, MOST_VIEWS + 1):
        await views.start_view(str(n), make)
    assert first.stopped
    assert views.ids() == [str(n) for n in range(1, MOST_VIEWS + 1)]
    with pytest.raises(Problem) as caught:
        await views.fetch("5", "", "identity")
    assert caught.value.status == 502
    await views.close()
    assert all(server.stopped for server in made)
