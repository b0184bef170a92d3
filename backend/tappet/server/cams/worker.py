"""Computes cams as a process of its own: reads orders from its input, writes outcomes to its output.

An outcome has the JSON of the answer as `body`, so that the web server only passes it on. The program with
the library is built for the first order that needs it.
"""

from __future__ import annotations

import traceback
from collections.abc import Callable
from pathlib import Path
from typing import Any

import msgspec

from tappet.motion.cam_curves import SegmentCurve, cam_curves
from tappet.motion.cam_import import imported_cam
from tappet.motion.cam_optimisation import optimised
from tappet.motion.cam_program import CamProgram, Numbers
from tappet.project.cams.cam_file import written_file
from tappet.project.cams.checks import findings
from tappet.project.cams.code import generated_code
from tappet.project.cams.point_lists import written_points
from tappet.project.cams.table import CamTable
from tappet.project.errors import ProjectError
from tappet.server.worker_loop import serve
from tappet.translation.sentences import sentence

COLUMNS = ("x", "y", "v", "a", "j")


class FaultyCamError(ProjectError):
    """There is no code of a cam with errors."""

    code = "faulty_cam"


class CamWorker:
    """Answers one order after the other."""

    def __init__(self) -> None:
        self._program: CamProgram | None = None

    def outcome(self, order: dict[str, Any]) -> dict[str, Any]:
        """What is sent back."""
        try:
            answer = _ANSWERS[order["do"]](self, CamTable.model_validate_json(order["cam"]), order)
        except ProjectError as error:
            return {
                "refusal": {"kind": error.code, "detail": str(error), "line": getattr(error, "line", None)}
            }
        except Exception as error:
            traceback.print_exc()
            return {"crash": f"{type(error).__name__}: {error}"}
        return {"body": msgspec.json.encode(answer)}

    def program(self, cache: str) -> CamProgram:
        """The compiled library."""
        if self._program is None:
            self._program = CamProgram(Path(cache))
        return self._program

    def curves(self, cam: CamTable, order: dict[str, Any]) -> dict[str, Any]:
        """The shape CamDrawing."""
        curves = cam_curves(self.program(order["cache"]), cam, order["samples"], order["at"])
        return {
            "segments": [_curve(one) for one in curves.segments],
            "at": [dict(zip(COLUMNS, row, strict=True)) for row in curves.at.tolist()],
            "findings": [
                {"severity": one.severity, "text": sentence(one.text, order["language"]), "x": one.x}
                for one in findings(cam)
            ],
        }

    def text(self, cam: CamTable, order: dict[str, Any]) -> dict[str, Any]:
        """The shape CamText."""
        if order["format"] == "cam":
            return {"text": written_file(order["name"], cam)}
        count, points_only = order["count"], order["points_only"]
        return {"text": written_points(cam, order["format"], count, points_only=points_only)}

    def from_text(self, cam: CamTable, order: dict[str, Any]) -> dict[str, Any]:
        """The shape ImportedCam."""
        found = imported_cam(order["text"], cam)
        return {"cam": found.cam.model_dump(), "removed_tappets": found.removed_tappets}

    def optimise(self, cam: CamTable, order: dict[str, Any]) -> dict[str, Any]:
        """The shape OptimisedCam."""
        found = optimised(cam, order["points"], order["goal"], order["keep_positions"])
        return {"cam": found.cam.model_dump(), "before": found.peaks.before, "after": found.peaks.after}

    def code(self, cam: CamTable, order: dict[str, Any]) -> dict[str, Any]:
        """The shape CamText."""
        for one in findings(cam):
            if one.severity == "error":
                raise FaultyCamError(one.text)
        return {"text": generated_code(order["name"], cam)}


_ANSWERS: dict[str, Callable[[CamWorker, CamTable, dict[str, Any]], Any]] = {
    "curves": CamWorker.curves,
    "text": CamWorker.text,
    "from-text": CamWorker.from_text,
    "optimise": CamWorker.optimise,
    "code": CamWorker.code,
}


def _curve(curve: SegmentCurve) -> dict[str, Any]:
    return _columns(curve.samples) | {
        "least": curve.least,
        "greatest": curve.greatest,
        "velocity": curve.velocity,
        "acceleration": curve.acceleration,
        "jerk": curve.jerk,
    }


def _columns(rows: Numbers) -> dict[str, Any]:
    return dict(zip(COLUMNS, rows.T.tolist(), strict=True))


if __name__ == "__main__":
    serve(CamWorker().outcome)
