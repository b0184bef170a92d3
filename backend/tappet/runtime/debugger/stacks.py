"""Call stacks that can be looked at: of halted tasks, and of one that a fault has ended."""

from __future__ import annotations

from tappet.runtime.debugger import frames
from tappet.runtime.debugger.shapes import Stack
from tappet.runtime.debugger.stepping import task_number
from tappet.runtime.debugger.variant import Variant
from tappet.runtime.errors import DebugError


def shown(variant: Variant, task: str) -> Stack:
    """As clients see it. Raises DebugError."""
    number, found = _stack(variant, task)
    name = variant.application.package.tasks[number].name
    cycle = variant.application.contexts.tasks[number]["cycle"]
    return Stack(name, cycle, frames.levels(variant, found))


def level(variant: Variant, task: str, frame: int) -> frames.FrameValues:
    """The variables of a level, the innermost is 0. Raises DebugError."""
    _, stack = _stack(variant, task)
    if not 0 <= frame < len(stack.activations):
        raise DebugError(f"the call stack of '{task}' has {len(stack.activations)} levels, from 0")
    return frames.FrameValues(variant, stack, stack.activations[frame])


def _stack(variant: Variant, task: str) -> tuple[int, frames.TaskStack]:
    number = task_number(variant, task)
    if number in variant.halted():
        return number, frames.stack_of_halted(variant, number)
    if variant.application.contexts.faulted_task() == number:
        found = frames.stack_of_fault(variant, number)
        if found is not None:
            return number, found
    raise DebugError(f"task '{task}' is not halted")
