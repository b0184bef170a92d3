"""One view of a CNC path as a process of its own: decodes, draws by viser and answers what the editor asks.

Decoding, levels of detail and viser take as much time as a path is long; here they hold up nobody but the
one who looks at it. An outcome has the JSON of the answer as `body`.
"""

from __future__ import annotations

import traceback
from collections.abc import Callable
from pathlib import Path
from typing import Any

from pydantic import BaseModel

from tappet.motion.path_service import PathService, PathSettingsError
from tappet.project.cnc.program import CncProgramData
from tappet.project.cnc.settings import CncSettingsData
from tappet.server.paths.seen_path import SeenPath
from tappet.server.paths.shapes import PathLooks
from tappet.server.spoken import in_language
from tappet.server.worker_loop import serve


class PathWorker:
    """Answers one order after the other."""

    def __init__(self) -> None:
        self._seen: SeenPath | None = None

    def outcome(self, order: dict[str, Any]) -> dict[str, Any]:
        """What is sent back."""
        try:
            return _ANSWERS[order["do"]](self, order)
        except PathSettingsError as error:
            return {"refusal": str(error)}
        except Exception as error:
            traceback.print_exc()
            return {"crash": f"{type(error).__name__}: {error}"}

    def open(self, order: dict[str, Any]) -> dict[str, Any]:
        """Starts viser; the outcome has the UNIX socket that it listens on."""
        from tappet.server.views.private_viser import PrivateViser

        server = PrivateViser()
        self._seen = SeenPath(server, PathService(Path(order["cache"])), _looks(order))
        return {"socket": str(server.socket)}

    def program(self, order: dict[str, Any]) -> dict[str, Any]:
        """Takes a program and draws it."""
        program = CncProgramData.model_validate_json(order["program"])
        settings = CncSettingsData.model_validate_json(order["settings"])
        return _body(self._path.take(program, settings, _looks(order)), order)

    def look(self, order: dict[str, Any]) -> dict[str, Any]:
        """Draws the same in another way."""
        return _body(self._path.look(_looks(order)), order)

    def choose(self, order: dict[str, Any]) -> dict[str, Any]:
        """Shows the elements of a line of the text as chosen."""
        return _body(self._path.choose(order["line"]), order)

    def pick(self, order: dict[str, Any]) -> dict[str, Any]:
        """The element that a ray meets."""
        return _body(self._path.pick(order["origin"], order["ahead"], order["angle"]), order)

    def motion(self, order: dict[str, Any]) -> dict[str, Any]:
        """The interpolated motion."""
        return _body(self._path.motion(), order)

    @property
    def _path(self) -> SeenPath:
        assert self._seen is not None, "the first order opens the view"
        return self._seen


def _looks(order: dict[str, Any]) -> PathLooks:
    return PathLooks.model_validate_json(order["looks"])


def _body(answer: BaseModel, order: dict[str, Any]) -> dict[str, Any]:
    return {"body": in_language(answer, order["language"]).model_dump_json().encode()}


_ANSWERS: dict[str, Callable[[PathWorker, dict[str, Any]], dict[str, Any]]] = {
    "open": PathWorker.open,
    "program": PathWorker.program,
    "look": PathWorker.look,
    "choose": PathWorker.choose,
    "pick": PathWorker.pick,
    "motion": PathWorker.motion,
}

if __name__ == "__main__":
    serve(PathWorker().outcome)
