"""Numbers by which a client asks for variables; they hold while the debuggee stands."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from tappet.server.dap.debuggee import Variable


@dataclass(frozen=True, slots=True)
class FrameScope:
    """Locals of a frame."""

    task: str
    frame: int


@dataclass(frozen=True, slots=True)
class Below:
    """Variables below a path of the image."""

    path: str


@dataclass(frozen=True, slots=True)
class Nested:
    """Parts of a structured value of a frame."""

    scope: FrameScope
    name: str
    """As the frame is asked to write it."""
    value: Any


Container = FrameScope | Below | Nested


class Handles:
    """Containers and frames by number, from 1."""

    def __init__(self) -> None:
        self._containers: list[Container] = []
        self._frames: list[tuple[str, int, str | None]] = []

    def clear(self) -> None:
        """The debuggee has moved: all numbers are void."""
        self._containers.clear()
        self._frames.clear()

    def container(self, container: Container) -> int:
        """Number of a container."""
        self._containers.append(container)
        return len(self._containers)

    def find(self, number: int) -> Container | None:
        """The container of a number."""
        return self._containers[number - 1] if 0 < number <= len(self._containers) else None

    def frame(self, task: str, index: int, instance: str | None) -> int:
        """Number of a frame."""
        self._frames.append((task, index, instance))
        return len(self._frames)

    def frame_of(self, number: int | None) -> tuple[str, int, str | None] | None:
        """Task, index in the stack, and instance of a frame."""
        return self._frames[number - 1] if number is not None and 0 < number <= len(self._frames) else None

    def below(self, variable: Variable, scope: FrameScope | None) -> int:
        """Number under which the parts of a variable are asked for; 0 where it has none."""
        if variable.path is not None:
            return self.container(Below(variable.path)) if variable.children else 0
        if scope is not None and isinstance(variable.value, dict | list) and variable.value:
            return self.container(Nested(scope, variable.name, variable.value))
        return 0
