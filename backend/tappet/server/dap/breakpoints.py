"""The breakpoints of a client: those of a file or all data breakpoints at a time, as the protocol sets
them.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any

from tappet.runtime.debugger.shapes import Hits
from tappet.server.dap import messages as m
from tappet.server.dap.connection import Handler
from tappet.server.dap.debuggee import Breakpoint, Wanted
from tappet.server.dap.view import View

_HIT = re.compile(r"\s*(?P<sign>>=|=|==|%)?\s*(?P<count>\d{1,9})\s*$")
_MODES: dict[str | None, Any] = {None: "from", ">=": "from", "=": "equal", "==": "equal", "%": "every"}


class Breakpoints:
    """Sets breakpoints and knows their numbers."""

    def __init__(self, view: View) -> None:
        self._view = view
        self._numbers: dict[str, int] = {}

    def handlers(self) -> dict[str, Handler]:
        """The requests that are carried out here."""
        return {
            "setBreakpoints": self._set_breakpoints,
            "setDataBreakpoints": self._set_data_breakpoints,
            "setExceptionBreakpoints": self._set_exception_breakpoints,
        }

    def number(self, breakpoint_id: str | None) -> int | None:
        """The number by which the client knows a breakpoint."""
        return self._numbers.get(breakpoint_id) if breakpoint_id is not None else None

    async def _set_breakpoints(self, request: m.Request) -> Any:
        given = m.arguments_as(m.SetBreakpoints, request)
        if given.source.path is None:
            return {
                "breakpoints": [self._unverified("Breakpoints are set in files") for _ in given.breakpoints]
            }
        wanted: list[Wanted | str] = [self._wanted(each) for each in given.breakpoints]
        found = await self._view.need().set_breakpoints(
            given.source.path, [w for w in wanted if isinstance(w, Wanted)]
        )
        return {"breakpoints": self._answers(wanted, found)}

    async def _set_data_breakpoints(self, request: m.Request) -> Any:
        given = m.arguments_as(m.SetDataBreakpoints, request)
        wanted: list[Wanted | str] = []
        for each in given.breakpoints:
            hits = _hits(each.hit_condition)
            data = Wanted(0, each.data_id, each.condition, hits) if isinstance(hits, Hits) else hits
            wanted.append(data)
        found = await self._view.need().set_data_breakpoints([w for w in wanted if isinstance(w, Wanted)])
        return {"breakpoints": self._answers(wanted, found)}

    async def _set_exception_breakpoints(self, _request: m.Request) -> Any:
        return {"breakpoints": []}  # every exception ends the application, so none can be let pass

    def _wanted(self, given: m.SourceBreakpoint) -> Wanted | str:
        hits = _hits(given.hit_condition)
        if isinstance(hits, str):
            return hits
        return Wanted(
            self._view.line_in(given.line), None, given.condition or None, hits, given.log_message or None
        )

    def _answers(self, wanted: Sequence[Wanted | str], found: Sequence[Breakpoint]) -> list[dict[str, Any]]:
        rest = iter(found)
        return [
            self._unverified(each) if isinstance(each, str) else self._breakpoint(next(rest))
            for each in wanted
        ]

    def _unverified(self, reason: str) -> dict[str, Any]:
        return {"verified": False, "message": self._view.say(reason)}

    def _breakpoint(self, found: Breakpoint) -> dict[str, Any]:
        number = self._numbers.setdefault(found.id, len(self._numbers) + 1)
        answer: dict[str, Any] = {"id": number, "verified": found.verified}
        if found.location is not None:
            answer |= {
                "source": self._view.source(found.location),
                "line": self._view.line_out(found.location.line),
            }
        if found.reason:
            answer["message"] = self._view.say(found.reason)
        return answer


def _hits(text: str | None) -> Hits | str:
    """`5` and `>= 5`: from the fifth hit on; `= 5`: at it alone; `% 5`: every fifth. Else what is wrong."""
    if not text or not text.strip():
        return Hits()
    found = _HIT.match(text)
    if found is None or int(found["count"]) == 0:
        forms = "5 or >= 5 (from the fifth hit on), = 5 (the fifth) or % 5 (every fifth)"
        return f"The hit condition '{text}' is none: write {forms}"
    return Hits(_MODES[found["sign"]], int(found["count"]))
