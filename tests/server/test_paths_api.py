"""The view of a CNC path over REST: drawn by the compiled decoder, asked by the editor."""

from __future__ import annotations

import math
import os
import signal
import subprocess
from typing import Any

import pytest
import viser
from fastapi.testclient import TestClient
from server_clients import SOCKETS, bare

PROJECTS = "/api/v1/projects"
PROGRAM = (
    "N0 G0 X10 Y0 F10 E10 E-10\nN10 G1 X110 Y0 H2 L25\nN20 G3 X110 Y40 R20\nN30 M7\nN40 G1 X110 Y40 Z5\n"
)

pytestmark = pytest.mark.slow
"""Each begins a process with viser and the compiled library."""


@pytest.fixture
def cnc(admin: TestClient) -> tuple[str, str]:
    """URL of the paths of a project, and the id of a CNC program in it."""
    url = f"{PROJECTS}/{admin.post(PROJECTS, json={'name': 'Mill'}).json()['id']}"
    objects = admin.get(f"{url}/objects").json()
    parent = next(item["id"] for item in objects if item["kind"] == "application")
    made = admin.post(f"{url}/objects", json={"kind": "cnc", "name": "Contour", "parent_id": parent}).json()
    data = {**made["data"], "implementation": PROGRAM}
    body = {"base_revision": made["revision"], "data": data}
    assert admin.put(f"{url}/objects/{made['id']}", json=body).status_code == 200
    return f"{url}/paths", made["id"]


def ask(client: TestClient, method: str, url: str, **options: Any) -> Any:
    answer = client.request(method, url, **options)
    assert answer.status_code in (200, 201), answer.text
    return answer.json()


def opened(client: TestClient, paths: str) -> tuple[str, str]:
    view = ask(client, "POST", paths, json={})
    return f"{paths}/{view['view_id']}", view["path"]


def test_a_path_is_drawn_chosen_picked_and_moved_along(admin: TestClient, cnc: tuple[str, str]) -> None:
    paths, program = cnc
    view, page = opened(admin, paths)
    drawn = ask(admin, "PUT", f"{view}/program", json={"object_id": program})
    assert drawn["objects"] == 5
    assert drawn["length"] == pytest.approx(10 + 100 + 20 * math.pi + 5)
    assert (drawn["start"], drawn["end"]) == ([0, 0, 0], [110, 40, 5])
    assert [mark["line"] for mark in drawn["ends"]] == [0, 1, 2, 4]
    assert drawn["switches"] == [{"place": [35, 0, 0], "line": 1, "number": 2}]
    assert (drawn["fault"], drawn["legend"]) == (None, None)

    elements = ask(admin, "PUT", f"{view}/line", json={"line": 2})["elements"]
    assert [(one["start"], one["end"]) for one in elements] == [([110, 0, 0], [110, 40, 0])]
    assert elements[0]["leave"] == pytest.approx([1, 0, 0], abs=2e-3)
    assert elements[0]["arrive"] == pytest.approx([-1, 0, 0], abs=2e-3)

    down = {"origin": [60, 0.4, 100], "ahead": [0, 0, -1], "angle": 0.01}
    found = ask(admin, "POST", f"{view}/pick", json=down)
    assert (found["element"]["line"], found["place"]) == (1, pytest.approx([60, 0, 0], abs=1e-9))
    beside = {**down, "origin": [60, 3, 100]}
    assert ask(admin, "POST", f"{view}/pick", json=beside)["element"] is None

    looks = {"colouring": "velocity"}
    legend = ask(admin, "PUT", f"{view}/looks", json=looks)["legend"]
    assert legend["by_motion"]
    assert legend["high"] == pytest.approx(10, rel=1e-6)
    samples = ask(admin, "GET", f"{view}/motion")
    assert samples["place"][-1] == pytest.approx([110, 40, 5], abs=1e-6)
    assert max(samples["velocity"]) == pytest.approx(10, rel=1e-6)
    assert max(abs(value) for value in samples["acceleration"]) <= 10 * 1.001
    # cnc EX-01: a second more at each stop, to accelerate and brake at 10 u/s².
    assert samples["duration"] == pytest.approx(1 + 1 + 10 + 1 + 2 * math.pi + 0.5 + 1 + 0.2, abs=3)

    with admin.websocket_connect(SOCKETS + page, subprotocols=[f"viser-v{viser.__version__}"]) as socket:
        assert len(socket.receive_bytes()) > 0
    assert admin.delete(view).status_code == 204
    assert admin.put(f"{view}/line", json={"line": 0}).status_code == 404
    assert admin.get(page).status_code == 404


def test_what_is_typed_is_drawn_up_to_its_fault(admin: TestClient, cnc: tuple[str, str]) -> None:
    """CNC-37: the path up to the last correct element, and why it ends there, in the reader's language."""
    paths, program = cnc
    view, _ = opened(admin, paths)
    typed = {"implementation": "N0 G1 X10 F10\nN10 G77 X20\nN20 G1 X30\n"}
    body = {"object_id": program, "program": typed}
    drawn = ask(admin, "PUT", f"{view}/program", json=body)
    assert (drawn["objects"], drawn["end"], drawn["fault_line"]) == (1, [10, 0, 0], 1)
    assert drawn["fault"] is not None
    other = next(
        item for item in admin.get(paths.replace("/paths", "/objects")).json() if item["kind"] == "task"
    )
    refused = admin.put(f"{view}/program", json={"object_id": other["id"]})
    assert (refused.status_code, refused.json()["type"]) == (422, "urn:tappet:problem:no-cnc")


def test_a_view_ends_with_its_process_and_strangers_get_none(admin: TestClient, cnc: tuple[str, str]) -> None:
    paths, program = cnc
    assert bare(admin.app).post(paths, json={}).status_code == 401  # type: ignore[arg-type]
    view, page = opened(admin, paths)
    found = subprocess.run(
        ["pgrep", "-P", str(os.getpid()), "-f", "tappet.server.paths.worker"], capture_output=True, text=True
    )
    process = int(found.stdout.split()[-1])
    os.kill(process, signal.SIGKILL)
    failed = admin.put(f"{view}/program", json={"object_id": program})
    assert (failed.status_code, failed.json()["type"]) == (500, "urn:tappet:problem:path-failed")
    assert admin.get(page).status_code == 404
    again, _ = opened(admin, paths)
    assert ask(admin, "PUT", f"{again}/program", json={"object_id": program})["objects"] == 5
