"""3D scenes: what is drawn for which values, what a scene may say, and the way to its view."""

from __future__ import annotations

from typing import Any

import pytest
from fake_plc import FakePlc
from fastapi import FastAPI
from fastapi.testclient import TestClient
from pydantic import ValidationError
from server_clients import bare

from tappet.project import folder
from tappet.project.scene import ColorChoice, Element, Linear, Repetition, Scene, Threshold
from tappet.server.example import find_example
from tappet.server.scenes.service import SceneServer
from tappet.server.scenes.view import color, number, visible
from tappet.server.services import Services


def element(**facts: Any) -> Element:
    return Element.model_validate({"name": "Bottle", "shape": "box", **facts})


def scene(*elements: dict[str, Any], **facts: Any) -> Scene:
    drawn = [{"name": "Bottle", "shape": "box", **more} for more in elements]
    return Scene.model_validate({"elements": drawn, **facts})


@pytest.mark.parametrize(
    ("value", "result"),
    [(10, 25.0), (-2.5, 0.0), (True, 7.0), (False, 5.0), (None, 5.0), (float("nan"), 5.0)],
)
def test_a_bound_number_follows_its_variable(value: object, result: float) -> None:
    assert number(Linear(variable="GVL.x", factor=2.0, offset=5.0), {"GVL.x": value}) == result


def test_a_number_without_its_variable_is_its_offset() -> None:
    assert number(Linear(variable="GVL.x", factor=2.0, offset=5.0), {"GVL.y": 3}) == 5.0
    assert number(12.5, {"GVL.x": 3}) == 12.5


def test_an_element_is_seen_from_its_threshold_on() -> None:
    bound = element(visible={"variable": "GVL.n", "at_least": 3})
    assert [visible(bound, {"GVL.n": n}) for n in (2, 2.99, 3, 4)] == [False, False, True, True]
    assert visible(bound, {}) is False
    lamp = element(visible={"variable": "GVL.x"})
    assert [visible(lamp, {"GVL.x": x}) for x in (False, True)] == [False, True]
    assert visible(element(), {}) is True
    assert visible(element(visible=False), {"GVL.x": True}) is False


def test_a_colour_is_chosen_by_its_variable() -> None:
    lamp = element(color={"variable": "GVL.x", "when_true": "#00ff10", "when_false": "#102030"})
    assert color(lamp, {"GVL.x": True}) == (0, 255, 16)
    assert color(lamp, {"GVL.x": False}) == (16, 32, 48)
    assert color(lamp, {}) == (16, 32, 48)
    assert color(element(color="#FF8000"), {}) == (255, 128, 0)


@pytest.mark.parametrize("value", ["a text", [1, 2], {"a": 1}])
def test_a_variable_that_is_no_number_counts_as_none(value: object) -> None:
    """A scene may name any variable; a wrong one must not stop the picture for all others."""
    assert number(Linear(variable="GVL.s", offset=4.0), {"GVL.s": value}) == 4.0
    assert visible(element(visible={"variable": "GVL.s"}), {"GVL.s": value}) is False


def test_repetitions_are_written_out_with_their_index() -> None:
    raw = scene(
        {
            "name": "Bottle {i}",
            "repeat": {"first": 2, "last": 4},
            "position": [{"variable": "PRG.aX[{i}]", "factor": 1.0}, 0.0, 0.0],
            "visible": {"variable": "PRG.nBottles", "at_least": "{i}"},
            "color": {"variable": "PRG.aFull[{i}]", "when_true": "#ffffff", "when_false": "#000000"},
            "text": "no. {i}: {}",
            "value": "PRG.aLevel[{i}]",
        },
        {"name": "Floor"},
    )
    bottles = list(raw.expanded())
    assert [b.name for b in bottles] == ["Bottle 2", "Bottle 3", "Bottle 4", "Floor"]
    first = bottles[0]
    assert first.repeat is None
    assert first.position[0] == Linear(variable="PRG.aX[2]")
    assert first.visible == Threshold(variable="PRG.nBottles", at_least=2.0)
    assert isinstance(first.color, ColorChoice)
    assert (first.color.variable, first.text, first.value) == ("PRG.aFull[2]", "no. 2: {}", "PRG.aLevel[2]")


def test_repeated_names_are_told_apart() -> None:
    names = [e.name for e in scene({"repeat": {"last": 3}}).expanded()]
    assert names == ["Bottle 1", "Bottle 2", "Bottle 3"]


def test_variables_are_listed_once_in_order_of_first_use() -> None:
    bound = scene(
        {
            "size": [1.0, {"variable": "GVL.w"}, 1.0],
            "position": [{"variable": "GVL.x"}, 0.0, {"variable": "GVL.w"}],
            "visible": {"variable": "GVL.on"},
        },
        {"name": "Sign", "shape": "label", "value": "GVL.n", "repeat": {"last": 2}},
        {"name": "Lamp", "color": {"variable": "GVL.on", "when_true": "#ffffff", "when_false": "#000000"}},
    )
    assert bound.variables() == ["GVL.w", "GVL.x", "GVL.on", "GVL.n"]
    assert Scene().variables() == []


@pytest.mark.parametrize(
    "facts",
    [
        {"color": "red"},
        {"color": "#12345"},
        {"shape": "teapot"},
        {"name": ""},
        {"name": "../up"},
        {"name": "a/b"},
        {"opacity": 0.0},
        {"opacity": 1.5},
        {"size": [1.0, 1.0]},
        {"position": [{"variable": ""}, 0.0, 0.0]},
        {"position": [float("nan"), 0.0, 0.0]},
        {"position": [float("inf"), 0.0, 0.0]},
        {"visible": {"variable": "GVL.x", "at_least": "many"}},
        {"visible": {"variable": "GVL.x", "at_least": "{i}"}},
        {"repeat": {"last": 1001}},
        {"repeat": {"first": -1_000_000_000, "last": 1}},
        {"repeat": {"first": 3, "last": 2}},
        {"script": "import os"},
    ],
)
def test_elements_that_say_nothing_sensible_are_refused(facts: dict[str, Any]) -> None:
    with pytest.raises(ValidationError):
        scene(facts)


@pytest.mark.parametrize("facts", [{"unit": 0.0}, {"unit": -1.0}, {"camera": {"position": [0.0, 0.0, 1.0]}}])
def test_scenes_that_say_nothing_sensible_are_refused(facts: dict[str, Any]) -> None:
    with pytest.raises(ValidationError):
        scene(**facts)


def test_two_bodies_of_one_name_are_refused() -> None:
    """The picture knows bodies by name: the second would take the place of the first."""
    with pytest.raises(ValidationError, match="Bottle"):
        scene({}, {})
    with pytest.raises(ValidationError, match="Bottle 2"):
        scene({"repeat": {"last": 3}}, {"name": "Bottle 2"})


def test_a_scene_cannot_hold_more_bodies_than_a_page_can_draw() -> None:
    many = [{"name": f"Row {row} {{i}}", "repeat": {"last": 1000}} for row in range(30)]
    with pytest.raises(ValidationError, match="bodies"):
        scene(*many)


def test_repetition_counts_from_one() -> None:
    assert Repetition(last=2).first == 1


def test_the_scene_of_the_example_is_shown_to_those_who_are_logged_in(
    app: FastAPI, services: Services, admin: TestClient, runtime_id: str, as_role: dict[str, TestClient]
) -> None:
    content = folder.load(find_example("bottling"))
    info = services.store.create_project(content.name, "ann", content=content)
    objects = admin.get(f"/api/v1/projects/{info.id}/objects").json()
    (drawn,) = [o for o in objects if o["kind"] == "scene"]
    url = f"/api/v1/projects/{info.id}/objects/{drawn['id']}/view"
    order = {"runtime_id": runtime_id}
    assert bare(app).post(url, json=order).status_code == 401

    opened = admin.post(url, json=order)
    assert opened.status_code == 200, opened.text
    path = opened.json()["path"]
    assert path.startswith("/views/")
    assert path.endswith("/")
    page = admin.get(path)
    assert page.status_code == 200
    assert "<title>Viser</title>" in page.text
    assert as_role["viewer"].get(path).status_code == 200, "looking needs no more than a viewer"
    assert bare(app).get(path).status_code == 401

    assert admin.post(url, json=order).json()["path"] == path, "the same view is joined"
    assert admin.post(url, json={**order, "dark": True}).json()["path"] != path
    refused = admin.post(url, json={"runtime_id": "nobody"})
    assert (refused.status_code, "nobody" in refused.json()["detail"]) == (404, True)
    program = next(o for o in objects if o["kind"] == "pou")
    refused = admin.post(url.replace(drawn["id"], program["id"]), json=order)
    assert refused.status_code == 422
    assert program["name"] in refused.json()["detail"]


def _drawn_scene(services: Services) -> tuple[str, str]:
    """A project with a scene whose only body is at x = PLC_PRG.nCount; its view's URL and the ids."""
    body = {"name": "Bottle", "shape": "box", "position": [{"variable": "PLC_PRG.nCount"}, 0.0, 0.0]}
    info = services.store.create_project("Plant", "ann")
    root = next(item for item in services.store.load(info.id).walk() if item.kind == "application")
    drawn = Scene.model_validate({"unit": 1.0, "elements": [body]})
    item = services.store.add(info.id, "ann", root.id, "scene", "Plant3D", data=drawn.model_dump(mode="json"))
    return info.id, item.id


def _x(services: Services, path: str) -> float:
    """Where the body of a view is drawn."""
    server = services.views.server_of(path.strip("/").split("/")[1])
    assert isinstance(server, SceneServer)
    return float(server._view._handles[0].position[0])


def test_a_view_of_the_past_shows_its_cycle(
    services: Services, admin: TestClient, runtime_id: str, plc: FakePlc
) -> None:
    for _ in range(5):
        plc.set("PLC_PRG.nCount", 100 + plc.cycle + 1)
        plc.run_cycle()
    plc.set("PLC_PRG.nCount", 7)
    project, scene_id = _drawn_scene(services)
    url = f"/api/v1/projects/{project}/objects/{scene_id}/view"
    opened = admin.post(url, json={"runtime_id": runtime_id, "cycle": 3})
    assert opened.status_code == 200, opened.text
    path = opened.json()["path"]
    assert _x(services, path) == 103.0
    assert "<title>Viser</title>" in admin.get(path).text
    view_id = path.strip("/").split("/")[1]
    assert admin.put(f"{url}/{view_id}/cycle", json={"cycle": 5}).status_code == 204
    assert _x(services, path) == 105.0
    refused = admin.put(f"{url}/{view_id}/cycle", json={"cycle": 99})
    assert (refused.status_code, "cycle 99 is not kept" in refused.json()["detail"]) == (409, True)
    assert _x(services, path) == 105.0, "it stays where it was"

    other = admin.post(url, json={"runtime_id": runtime_id, "cycle": 3}).json()["path"]
    assert other != path, "everybody looks at a cycle of his own"
    live = admin.post(url, json={"runtime_id": runtime_id}).json()["path"]
    refused = admin.put(f"{url}/{live.strip('/').split('/')[1]}/cycle", json={"cycle": 3})
    assert refused.status_code == 404, "the present is shared: nobody moves it"
    assert admin.put(f"{url}/nobody/cycle", json={"cycle": 3}).status_code == 404


def test_a_cycle_that_is_not_kept_opens_no_view(
    services: Services, admin: TestClient, runtime_id: str, plc: FakePlc
) -> None:
    plc.run_cycle()
    project, scene_id = _drawn_scene(services)
    before = services.views.ids()
    url = f"/api/v1/projects/{project}/objects/{scene_id}/view"
    refused = admin.post(url, json={"runtime_id": runtime_id, "cycle": 99})
    assert (refused.status_code, "cycle 99 is not kept" in refused.json()["detail"]) == (409, True)
    assert services.views.ids() == before
