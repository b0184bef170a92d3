"""Draws a project scene in viser and keeps it moving with values of the running application."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from tappet.project.scene import ColorChoice, Element, Linear, Number, Scene, Threshold

if TYPE_CHECKING:
    import viser

Values = Mapping[str, Any]
"""Decoded values by variable; a variable that could not be read is missing."""


def number(bound: Number, values: Values) -> float:
    """The value of a fixed or bound number; a variable that is not there or no finite number counts as 0."""
    if isinstance(bound, Linear):
        return bound.offset + bound.factor * _measure(values.get(bound.variable))
    return bound


def visible(element: Element, values: Values) -> bool:
    """Whether the element is drawn now."""
    if isinstance(element.visible, Threshold):
        return _measure(values.get(element.visible.variable)) >= float(element.visible.at_least)
    return element.visible


def color(element: Element, values: Values) -> tuple[int, int, int]:
    """Red, green and blue, 0..255."""
    text = element.color
    if isinstance(text, ColorChoice):
        text = text.when_true if values.get(text.variable) else text.when_false
    return int(text[1:3], 16), int(text[3:5], 16), int(text[5:7], 16)


class SceneView:
    """One viser scene. `update` sends only what has changed since the last call."""

    def __init__(self, server: viser.ViserServer, scene: Scene, *, dark: bool = False) -> None:
        self._scene = scene
        self._elements = list(scene.expanded())
        self._handles: list[Any] = []
        self._shown: list[tuple[object, ...]] = []
        self._draw(server, dark)

    def _draw(self, server: viser.ViserServer, dark: bool) -> None:
        server.gui.configure_theme(show_logo=False, show_share_button=False, dark_mode=dark)
        server.gui.main_panel.minimize()
        server.gui.set_panel_label("3D")
        server.scene.set_up_direction("+z")
        server.scene.add_grid(
            "/floor", 20.0, 20.0, cell_size=0.5, section_size=2.5, infinite_grid=True, fade_distance=12.0,
            cell_color=(72, 76, 82) if dark else (214, 217, 221),
            section_color=(92, 97, 104) if dark else (190, 194, 200),
        )  # fmt: skip
        for element in self._elements:
            self._handles.append(self._add(server, element))
            self._shown.append(())
        self.update({})
        camera = self._scene.camera
        if camera is not None:
            unit = self._scene.unit
            x, y, z = camera.position
            server.initial_camera.position = (unit * x, unit * y, unit * z)
            x, y, z = camera.look_at
            server.initial_camera.look_at = (unit * x, unit * y, unit * z)

    def _add(self, server: viser.ViserServer, element: Element) -> Any:
        name = "/" + element.name.replace(" ", "_")
        tint = color(element, {})
        opacity = element.opacity if element.opacity < 1.0 else None
        match element.shape:
            case "box":
                return server.scene.add_box(name, color=tint, dimensions=(1.0, 1.0, 1.0), opacity=opacity)
            case "cylinder":
                return server.scene.add_cylinder(name, radius=0.5, height=1.0, color=tint, opacity=opacity)
            case "sphere":
                return server.scene.add_icosphere(name, radius=0.5, color=tint, opacity=opacity)
            case "label":
                return server.scene.add_label(name, element.text, anchor="bottom-center")

    def update(self, values: Values) -> None:
        """Moves, scales, colours and shows every element by the given values."""
        unit = self._scene.unit
        for i, element in enumerate(self._elements):
            size = tuple(unit * max(number(s, values), 1e-6) for s in element.size)
            x, y, z = (unit * number(p, values) for p in element.position)
            shown = visible(element, values)
            tint = color(element, values)
            text = element.text
            if element.value is not None:
                text = text.replace("{}", _text(values.get(element.value)))
            state = (size, x, y, z, shown, tint, text)
            if state == self._shown[i]:
                continue
            self._shown[i] = state
            handle = self._handles[i]
            handle.visible = shown
            if element.shape == "label":
                handle.position = (x, y, z)
                handle.text = text
                continue
            handle.position = (x, y, z + size[2] / 2.0)
            handle.scale = size
            handle.color = tint


def _measure(value: object) -> float:
    return float(value) if isinstance(value, (int, float)) and math.isfinite(value) else 0.0


def _text(value: object) -> str:
    if isinstance(value, bool):
        return "TRUE" if value else "FALSE"
    if isinstance(value, float):
        return f"{value:.1f}"
    return "–" if value is None else str(value)
