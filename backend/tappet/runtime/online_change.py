"""Online change: a running application becomes another one without stopping (LDEC-47, LDEC-106).

When only code changed, code pointers are exchanged beside the running tasks. When data moved, all tasks
stand at their cycle boundary while the image is rearranged.
"""

from __future__ import annotations

from contextlib import nullcontext
from dataclasses import dataclass
from pathlib import Path

from tappet.codegen.package import ONLINE_CHANGE_SYMBOL, CodePackage, left_behind, rearranged
from tappet.runtime.application import LoadedApplication
from tappet.runtime.exception_report import ExceptionReport
from tappet.runtime.logbook import Logbook
from tappet.runtime.places import Place, find_again
from tappet.runtime.reports import build_report
from tappet.runtime.retain_groups import remanent_by_task
from tappet.runtime.tasks import TaskOwnership


class OnlineChangeError(RuntimeError):
    """The running application cannot become this one; a download is needed."""


DURING = "online change"
"""What the code of FB_Exit, FB_Init and FB_Reinit runs in that a change calls."""


@dataclass(frozen=True, slots=True)
class ChangeResult:
    """What happened to forces and to the code that the change itself ran."""

    report: ExceptionReport | None
    lost_forces: tuple[Place, ...] = ()
    paused: bool = False
    retain_problem: str = ""
    """Why remanent variables are kept no more."""


def check_change(running: CodePackage, package: CodePackage) -> None:
    """OnlineChangeError saying why `package` cannot follow `running`."""
    change = package.online_change
    if change is None:
        raise OnlineChangeError("the package was not built as an online change; download it")
    if change.refused:
        raise OnlineChangeError(change.refused)
    if change.base_code_id != running.code_id or change.base_data_id != running.data_id:
        raise OnlineChangeError(
            "the package was built against another application than the running one; build again or download"
        )
    before = [(t.name, t.kind, t.priority, t.processors, t.policy) for t in running.tasks]
    after = [(t.name, t.kind, t.priority, t.processors, t.policy) for t in package.tasks]
    if before != after:
        raise OnlineChangeError(
            "tasks were added, removed or changed in kind, priority or task group; download the application"
        )
    for name in ("tappet.area.I", "tappet.area.Q"):
        old, new = running.data_objects.get(name), package.data_objects.get(name)
        if (old.size if old else 0) != (new.size if new else 0):
            raise OnlineChangeError("the size of the input or output area changed; download the application")


def apply_change(
    application: LoadedApplication, package: CodePackage, retain_folder: Path | None, log: Logbook
) -> ChangeResult:
    """Make `application` run `package`. Nothing has changed when it raises OnlineChangeError, ImageError or
    LinkError.
    """
    running = application.package
    check_change(running, package)
    change = package.online_change
    assert change is not None
    if package.image_size > application.image.capacity:
        application.image.resize(package.image_size)  # raises, and says how large it may be
    code = application.link(package)
    only_code = (
        not change.moves
        and not change.initialise
        and package.data_id == running.data_id
        and package.tasks == running.tasks
        and ONLINE_CHANGE_SYMBOL not in package.exports
    )
    old_code = application.code
    if only_code:
        debugged = application.variant is not None
        # a task that met a breakpoint of the variant meanwhile would wait there for ever
        with application.tasks.standing() if debugged else nullcontext():
            _end_traces(application, log)
            application.package = package
            application.count_change()
            application.connect_code(code)
            application.drop_variant()
        application.tasks.retire(old_code, old_code.close)
        return ChangeResult(None, paused=debugged)
    with application.tasks.standing():
        # what FB_Exit does with other objects is to be seen in what they keep
        report = None
        for function in left_behind(running, package):
            fault = application.call_beside(DURING, old_code[function])
            if fault is not None and report is None:  # its place is known as long as its code is there
                report = build_report(application, log)
        _end_traces(application, log)
        _rearrange(application, package)
        application.outside.clear()
        application.package = package
        application.count_change()
        application.connect_code(code)
        application.drop_variant()
        lost = _relocate(application, running, package)
        application.watched.load(package)
        problem = ""
        remanence = remanent_by_task(running) != remanent_by_task(package)
        if remanence and retain_folder is not None:
            try:
                application.open_retain_file(retain_folder)
            except OSError as error:
                problem = str(error)
        if ONLINE_CHANGE_SYMBOL in package.exports:
            fault = application.call_beside(DURING, code[ONLINE_CHANGE_SYMBOL])
            if fault is not None and report is None:
                report = build_report(application, log)
        application.files.sweep()
        if report is not None:
            application.mark_faulted()
        old_code.close()
        application.connect_flight()  # in what was kept, places would name other variables
    return ChangeResult(report, tuple(lost), paused=True, retain_problem=problem)


def _end_traces(application: LoadedApplication, log: Logbook) -> None:
    """Traces were made for the application as it was (TRC-70)."""
    ended = application.sampled.end_traces()
    if ended:
        log.add("info", "trace", f"ended by the online change: {', '.join(ended)}")


def _rearrange(application: LoadedApplication, package: CodePackage) -> None:
    """Old values to their new places, new variables to their initial values."""
    image = application.image
    new = rearranged(package, image.read(0, image.size))
    image.resize(package.image_size)
    image.write(0, bytes(new))


def _relocate(application: LoadedApplication, before: CodePackage, after: CodePackage) -> list[Place]:
    """Find tasks' event variables, forces and recorders again; returns the places of forces that are gone."""
    contexts, image = application.contexts, application.image.address
    application.ownership = TaskOwnership(after)
    for spec, task in zip(after.tasks, contexts.tasks, strict=True):
        contexts.fill_task(spec, task, image, application.stuck_limit_s)
    application.connect_io()
    moved = {v.place: find_again(before.symbols, after.symbols, v.place) for v in application.forces.values}
    lost = application.forces.move(moved)
    application.publish_forces()
    for recorders in application.recorders.values():
        for recorder in recorders:
            places = [
                find_again(before.symbols, after.symbols, Place(offset, size))
                for offset, size in recorder.located
            ]
            # a variable that is gone keeps its old place, so that the frame keeps its form
            recorder.locate(
                [
                    (place.offset, place.size) if place is not None else old
                    for place, old in zip(places, recorder.located, strict=True)
                ],
                image,
            )
    return lost
