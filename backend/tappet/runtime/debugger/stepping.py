"""How halted tasks go on: the orders that the executive reads in DEBUG_TASK."""

from __future__ import annotations

import time

from tappet.runtime.contexts import RUNNING
from tappet.runtime.debugger import frames
from tappet.runtime.debugger.shapes import Command
from tappet.runtime.debugger.variant import Variant
from tappet.runtime.errors import DebugError

RUN, INTO, FRAMES = 0, 1, 2
"""STEP_MODE of debug_types.st."""
STEP_PATIENCE_S = 0.25
"""A step mostly ends at once: its answer then says where."""


def task_number(variant: Variant, name: str) -> int:
    """Index of a task of the application. Raises DebugError."""
    names = [task.name.upper() for task in variant.application.package.tasks]
    if name.upper() not in names:
        raise DebugError(f"the application has no task '{name}'")
    return names.index(name.upper())


def halted_task(variant: Variant, name: str | None) -> int:
    """The halted task that is meant; without a name the only one. Raises DebugError."""
    halted = variant.halted()
    if name is not None:
        task = task_number(variant, name)
        if task not in halted:
            raise DebugError(f"task '{name}' is not halted")
        return task
    if len(halted) != 1:
        raise DebugError("several tasks are halted: name one" if halted else "no task is halted")
    return halted[0]


def ask_to_pause(variant: Variant, name: str | None) -> None:
    """Let a task halt at its next statement; all with None. Raises DebugError."""
    if variant.application.tasks.state != RUNNING:
        raise DebugError("the application does not run")
    tasks = range(len(variant.tasks)) if name is None else [task_number(variant, name)]
    for i in tasks:
        if not variant.tasks[i]["halted"]:
            variant.executive.store_flag(variant.tasks[i].place("pause"), 1)


def mark_frames(variant: Variant, task: int, command: Command, mark: int) -> None:
    """The activations in which a step over or out of the present one may end."""
    stack = frames.stack_of_halted(variant, task)
    for activation in stack.activations[1 if command == "step_out" else 0 :]:
        frames.mark(variant, activation, mark)
    variant.tasks[task]["mark"] = mark


def order(variant: Variant, tasks: list[int], mode: int) -> None:
    """How halted tasks are to go on; nothing else is to pause when all of them run."""
    for i in tasks:
        variant.tasks[i]["mode"] = mode
    if mode == RUN and len(tasks) == len(variant.halted()):
        for task in variant.tasks:
            task["pause"] = 0


def resume(variant: Variant, tasks: list[int]) -> None:
    """Let them go, until they have taken the order: one that halts again has halted anew."""
    for i in tasks:
        variant.executive.store_flag(variant.tasks[i].place("resume"), 1)
    end = time.monotonic() + STEP_PATIENCE_S
    while any(variant.tasks[i]["resume"] for i in tasks) and time.monotonic() < end:
        time.sleep(0.0002)
