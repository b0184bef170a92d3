"""Draws a path in viser, as fine as the camera sees it (cnc.md CNC-50 to CNC-53).

Paths have any place and size; they are drawn in a frame of their own, so that single precision and the
bounds of the camera fit: `Frame` says where it lies.
"""

from __future__ import annotations

import math
import threading
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from tappet.motion.paths.geo_info import Numbers
from tappet.motion.paths.levels import MOST_DRAWN, Camera, Levels
from tappet.motion.paths.polyline import Polyline
from tappet.motion.paths.shades import DARK, LIGHT, Colours, Theme

if TYPE_CHECKING:
    import viser

EXTENT = 100.0
"""How large the path is in the frame of the picture."""
FIELD_OF_VIEW = math.radians(35.0)
PAUSE_S = 0.12
"""Between two pictures of a camera that moves."""
WIDE = 1.3
"""The part around the picture that is drawn too, so that a camera may move a little."""
RED = (214, 40, 40)
AXES = ((214, 40, 40), (30, 150, 60), (40, 90, 220))
CELLS = 20
_SHARE = np.arange(256) / 255.0
_LIGHT_OF = np.round(
    255.0 * np.where(_SHARE <= 0.04045, _SHARE / 12.92, ((_SHARE + 0.055) / 1.055) ** 2.4)
).astype(np.uint8)
"""viser takes colours of lines as amounts of light: the inverse of the transfer function of sRGB."""
_NO_LINES = np.zeros((1, 2, 3), np.float32)
"""viser wants one line at least; this one has no length."""


@dataclass(frozen=True, slots=True)
class Frame:
    """The frame of the picture: a place there is `(place - centre) * scale`."""

    centre: Numbers
    scale: float

    def of(self, places: Numbers) -> npt.NDArray[np.float32]:
        """Places of the path in the picture."""
        return np.asarray((places - self.centre) * self.scale, np.float32)

    @classmethod
    def around(cls, low: Numbers, high: Numbers) -> Frame:
        """That of a path in a box."""
        size = float(np.linalg.norm(high - low))
        return cls((low + high) / 2, EXTENT / size if size > 0 else 1.0)

    def fits(self, low: Numbers, high: Numbers) -> bool:
        """Whether a path may stay in this frame, so that the camera does not jump while one edits."""
        size = float(np.linalg.norm(high - low)) * self.scale
        away = float(np.linalg.norm((low + high) / 2 - self.centre)) * self.scale
        return EXTENT / 20 < size < 20 * EXTENT and away < 20 * EXTENT


@dataclass(frozen=True, slots=True)
class Layer:
    """A path with the colours of its pieces."""

    path: Polyline
    levels: Levels
    colours: Colours


class Picture:
    """One viser scene with a path. Threads of viser call in when the camera moves."""

    def __init__(self, server: viser.ViserServer, *, dark: bool) -> None:
        self._server = server
        self._lock = threading.RLock()
        self._wake = threading.Event()
        self._closed = False
        self._layers: dict[str, Layer] = {}
        self._handles: dict[str, Any] = {}
        self.frame = Frame(np.zeros(3), 1.0)
        self._framed = False
        self.theme: Theme = DARK if dark else LIGHT
        self._grid_shown = True
        server.gui.configure_theme(show_logo=False, show_share_button=False, dark_mode=dark)
        server.gui.main_panel.minimize()
        server.scene.set_up_direction("+z")
        far = EXTENT / 2 / math.sin(FIELD_OF_VIEW / 2) * 1.15
        camera = server.initial_camera
        camera.fov, camera.near, camera.far = FIELD_OF_VIEW, 0.05, 1e4
        camera.position, camera.look_at = (0.0, -far * 1e-4, far), (0.0, 0.0, 0.0)
        self._place_grid()
        server.on_client_connect(self._watch)
        threading.Thread(target=self._follow, daemon=True, name="level of detail").start()

    def close(self) -> None:
        """Ends following the camera."""
        self._closed = True
        self._wake.set()

    def look(self, *, dark: bool, grid: bool) -> None:
        """Colours and grid."""
        theme = DARK if dark else LIGHT
        if theme is not self.theme or grid != self._grid_shown:
            if theme is not self.theme:
                self._server.gui.configure_theme(show_logo=False, show_share_button=False, dark_mode=dark)
            self.theme, self._grid_shown = theme, grid
            self._place_grid()

    def show(self, layers: dict[str, Layer]) -> None:
        """The paths, by name, from the one behind to the one in front."""
        with self._lock:
            boxes = [(one.levels.low, one.levels.high) for one in layers.values() if len(one.path.of)]
            if boxes:
                low = np.min([box[0] for box in boxes], axis=0)
                high = np.max([box[1] for box in boxes], axis=0)
                if not (self._framed and self.frame.fits(low, high)):
                    self.frame, self._framed = Frame.around(low, high), True
                    self._place_grid()
            self._layers = layers
            for name in ("original", "path"):
                self._draw(name)

    def mark(self, rows: list[Numbers]) -> None:
        """The chosen elements, each as a row of points, in red."""
        parts = [np.stack([row[:-1], row[1:]], axis=1) for row in rows if len(row) > 1]
        lines = self.frame.of(np.concatenate(parts)) if parts else _NO_LINES
        with self._lock:
            self._lines("chosen", lines, np.broadcast_to(np.array(RED, np.uint8), lines.shape), thickness=5.0)

    def _draw(self, name: str) -> None:
        layer = self._layers.get(name)
        if layer is None or not len(layer.path.of):
            self._lines(name, _NO_LINES, np.zeros((1, 2, 3), np.uint8), thickness=1.0)
            return
        path = layer.path
        if len(path.of) <= MOST_DRAWN:
            start = np.flatnonzero(path.of >= 0)
            end, piece = start + 1, start
        else:
            chosen = layer.levels.choose(self._camera())
            start, end, piece = chosen.start, chosen.end, chosen.piece
        if not len(start):
            self._lines(name, _NO_LINES, np.zeros((1, 2, 3), np.uint8), thickness=1.0)
            return
        lines = np.stack([self.frame.of(path.points[start]), self.frame.of(path.points[end])], axis=1)
        colours = np.repeat(layer.colours[piece][:, None], 2, axis=1)
        self._lines(name, lines, colours, thickness=1.5 if name == "original" else 3.0)

    def _lines(
        self, name: str, lines: npt.NDArray[np.float32], colours: npt.NDArray[np.uint8], *, thickness: float
    ) -> None:
        self._handles[name] = self._server.scene.add_line_segments(
            f"/{name}", lines, _LIGHT_OF[colours], thickness=thickness, thickness_units="screen"
        )

    def _place_grid(self) -> None:
        """The plane Z = 0 and the axes at the origin."""
        size = EXTENT / self.frame.scale
        cell = 10.0 ** math.floor(math.log10(size / CELLS)) if size > 0 else 1.0
        cell *= next((factor for factor in (1, 2, 5) if cell * factor * CELLS >= size), 10)
        origin = self.frame.of(np.zeros(3)[None])[0]
        centre = np.round(self.frame.centre / (5 * cell)) * 5 * cell
        place = self.frame.of(np.array([[centre[0], centre[1], 0.0]]))[0]
        small = cell * self.frame.scale
        self._server.scene.add_grid(
            "/floor", 100.0 * small, 100.0 * small, cell_size=small, section_size=5 * small,
            cell_color=self.theme.grid, section_color=self.theme.section,
            cell_thickness=0.6, section_thickness=0.9,
            position=(float(place[0]), float(place[1]), float(place[2])), visible=self._grid_shown,
        )  # fmt: skip
        ends = origin + np.eye(3, dtype=np.float32) * np.float32(EXTENT / 8)
        lines = np.stack([np.broadcast_to(origin, (3, 3)), ends], axis=1).astype(np.float32)
        colours = np.repeat(np.array(AXES, np.uint8)[:, None], 2, axis=1)
        with self._lock:
            self._lines("axes", lines, colours, thickness=3.0)

    def _camera(self) -> Camera:
        """Where the newest browser looks from, in path units; from above while there is none."""
        clients = list(self._server.get_clients().values())
        if not clients:
            far = EXTENT / 2 / math.sin(FIELD_OF_VIEW / 2) / self.frame.scale
            place = self.frame.centre + np.array([0.0, 0.0, far])
            return Camera(place, np.array([0.0, 0.0, -1.0]), FIELD_OF_VIEW / 800, FIELD_OF_VIEW)
        camera = clients[-1].camera
        ahead = np.asarray(camera.look_at) - np.asarray(camera.position)
        ahead = ahead / max(float(np.linalg.norm(ahead)), 1e-12)
        height = max(int(camera.image_height), 1)
        wide = math.hypot(1.0, camera.image_width / height)
        cone = min(WIDE * math.atan(wide * math.tan(camera.fov / 2)), math.pi)
        place = self.frame.centre + np.asarray(camera.position) / self.frame.scale
        return Camera(place, ahead, camera.fov / height, cone)

    def _watch(self, client: Any) -> None:
        client.camera.on_update(lambda _: self._wake.set())
        self._wake.set()

    def _follow(self) -> None:
        """Draws large paths again as the camera moves."""
        while not self._closed:
            self._wake.wait()
            self._wake.clear()
            with self._lock:
                for name, layer in self._layers.items():
                    if len(layer.path.of) > MOST_DRAWN:
                        self._draw(name)
            threading.Event().wait(PAUSE_S)
