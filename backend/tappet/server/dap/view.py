"""What a client sees of a debuggee: how it counts lines, its numbers, and the cycle it looks at."""

from __future__ import annotations

from typing import Any

from tappet.server.dap.debuggee import Debuggee, Location, PastCycle, Refused
from tappet.server.dap.handles import Handles
from tappet.server.dap.messages import Initialize
from tappet.translation.language import Language
from tappet.translation.sentences import sentence


class View:
    """Shared by the parts of a session."""

    def __init__(self) -> None:
        self.initialize = Initialize()
        self.language: Language = "en"
        self.debuggee: Debuggee | None = None
        self.handles = Handles()
        self.past: list[PastCycle] = []
        self.at: int | None = None
        """Index in `past` of the cycle that is shown; None for the present."""
        self._references: list[str] = []

    def say(self, english: str) -> str:
        """A sentence in the language of the client."""
        return sentence(english, self.language)

    def need(self) -> Debuggee:
        """The debuggee. Raises Refused before there is one."""
        if self.debuggee is None:
            raise Refused("Nothing is debugged: send launch or attach first")
        return self.debuggee

    @property
    def cycle(self) -> int | None:
        """The past cycle that is shown."""
        return self.past[self.at].number if self.at is not None else None

    def refuse_past(self) -> None:
        """Raises Refused while a past cycle is shown."""
        if self.at is not None:
            raise Refused("The past cannot be changed: continue first")

    # -- tasks are threads -------------------------------------------------------------------------------

    def thread(self, task: str) -> int:
        """Number of a task."""
        tasks = [name.casefold() for name in self.need().tasks]
        return tasks.index(task.casefold()) + 1 if task.casefold() in tasks else 1

    def task(self, thread: int) -> str:
        """Task of a number. Raises Refused."""
        tasks = self.need().tasks
        if not 0 < thread <= len(tasks):
            raise Refused(f"There is no thread {thread}")
        return tasks[thread - 1]

    # -- lines and texts ---------------------------------------------------------------------------------

    def line_in(self, line: int) -> int:
        """A line of the client, from 1."""
        return line if self.initialize.lines_start_at1 else line + 1

    def line_out(self, line: int) -> int:
        """A line from 1, as the client counts."""
        return line if self.initialize.lines_start_at1 else line - 1

    def source(self, location: Location) -> dict[str, Any]:
        """A text as the client finds it."""
        source: dict[str, Any] = {"name": location.name}
        if location.path is not None:
            source["path"] = location.path
        if location.reference is not None:
            if location.reference not in self._references:
                self._references.append(location.reference)
            source["sourceReference"] = self._references.index(location.reference) + 1
            if location.path is None:  # of a library
                source["presentationHint"] = "deemphasize"
        return source

    def reference(self, number: int) -> str:
        """The text that was given a number. Raises Refused."""
        if not 0 < number <= len(self._references):
            raise Refused(f"There is no text {number}")
        return self._references[number - 1]
