"""Runs CNC programs as a process of its own: reads orders from its input, writes outcomes to its output."""

from __future__ import annotations

import traceback
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from tappet.cnc.checks import check
from tappet.cnc.parser import parse
from tappet.libraries import load
from tappet.motion.generated_cnc import FaultyProgramError, generated_code
from tappet.motion.path_blocks import LIBRARY, path_blocks
from tappet.motion.path_service import Motion, PathFault, PathObjects, PathService, PathSettingsError
from tappet.project.cnc.code import program_name
from tappet.project.cnc.program import CncProgramData
from tappet.project.cnc.settings import CncSettingsData
from tappet.server.cnc.shapes import CncBlock, CncBlocks, CncCode, CncFault, CncInfo, CncPathFacts
from tappet.server.shapes import Reply
from tappet.server.spoken import in_language
from tappet.server.worker_loop import serve
from tappet.translation.language import Language


@dataclass(frozen=True, slots=True)
class _Order:
    name: str
    program: CncProgramData
    settings: CncSettingsData
    paths: PathService
    language: Language


class CncWorker:
    """Answers one order after the other."""

    def __init__(self) -> None:
        self._paths: PathService | None = None

    def outcome(self, order: dict[str, Any]) -> dict[str, Any]:
        """What is sent back."""
        try:
            answer = _ANSWERS[order["do"]](
                _Order(
                    order["name"],
                    CncProgramData.model_validate_json(order["program"]),
                    CncSettingsData.model_validate_json(order["settings"]),
                    self._service(order["cache"]),
                    order["language"],
                )
            )
        except (PathSettingsError, FaultyProgramError) as error:
            kind = "cnc-settings" if isinstance(error, PathSettingsError) else "faulty-cnc"
            return {"refusal": {"kind": kind, "detail": str(error), "line": None}}
        except Exception as error:
            traceback.print_exc()
            return {"crash": f"{type(error).__name__}: {error}"}
        return {"body": in_language(answer, order["language"]).model_dump_json().encode()}

    def _service(self, cache: str) -> PathService:
        if self._paths is None:
            self._paths = PathService(Path(cache))
        return self._paths


def info(order: _Order) -> CncInfo:
    """The shape CncInfo."""
    program, settings, paths = order.program, order.settings, order.paths
    text = parse(program.implementation)
    plain = paths.interpolated(program, settings, preprocessing=False)
    chain = settings.preprocessing
    return CncInfo(
        name=program_name(order.name, program.implementation),
        library=load(LIBRARY).version,
        lines=sum(not line.is_empty for line in text.lines),
        errors=sum(problem.severity == "error" for problem in check(text.lines)),
        path=_facts(paths.objects_of(program), plain),
        preprocessed=_facts(paths.preprocessed(program, settings), paths.interpolated(program, settings))
        if chain
        else None,
    )


def code(order: _Order) -> CncCode:
    """The shape CncCode."""
    return CncCode(text=generated_code(order.name, order.program, order.settings, order.paths))


def blocks(order: _Order) -> CncBlocks:
    """The shape CncBlocks, in the language of the order."""
    return CncBlocks(
        blocks=[CncBlock.of(block).in_language(order.language) for block in path_blocks().values()]
    )


def _facts(path: PathObjects, motion: Motion) -> CncPathFacts:
    fault = path.fault or motion.fault
    duration = motion.duration_s if fault is None else None
    return CncPathFacts(
        objects=len(path.rows),
        length=path.length,
        duration=duration,
        fault=None if fault is None else _fault(fault),
    )


def _fault(fault: PathFault) -> CncFault:
    return CncFault(message=fault.message, line=fault.line, column=fault.column, length=fault.length)


_ANSWERS: dict[str, Callable[[_Order], Reply]] = {"info": info, "code": code, "blocks": blocks}


if __name__ == "__main__":
    serve(CncWorker().outcome)
