"""`tappet replay`: a recording of the flight recorder runs again on virtual time."""

from __future__ import annotations

from argparse import Namespace
from pathlib import Path
from typing import TYPE_CHECKING

from tappet.cli.arguments import ArgumentParser, integer
from tappet.cli.errors import UsageError, complain
from tappet.cli.output import counted, show_json

if TYPE_CHECKING:
    from tappet.runtime.exception_report import ExceptionReport
    from tappet.runtime.flight_recording import FlightRecording
    from tappet.runtime.replay_process import ReplayResult


def replay_arguments(parser: ArgumentParser) -> None:
    """What to replay, on which code, and what to show."""
    parser.add_argument(
        "recording",
        type=Path,
        metavar="FILE|PROJECT/OBJECT",
        help="a .flight file, or an object of a project folder by its name",
    )
    parser.path_option(
        "--on",
        metavar="PROJECT",
        help="run what was recorded on the program of this project, by the names of its variables: good when"
        " it does not fail",
    )
    parser.add_argument(
        "--until-fault", action="store_true", help="fail unless the recorded fault comes again"
    )
    parser.add_argument("--until", type=integer(0), metavar="CYCLE", help="end behind this cycle")
    parser.add_argument(
        "--print", dest="show", action="append", default=[], metavar="EXPR", help="print a value at the end"
    )
    parser.application_option("which application of the project of --on")
    parser.format_option()


def replay(given: Namespace) -> int:
    """0: as recorded, or with --on without a fault; 1 otherwise."""
    from tappet.runtime.flight_recording import RecordingError, read_recording
    from tappet.runtime.replay_process import ReplayOrder, replay_in_process

    text = recording_text(given.recording)
    try:
        recording = read_recording(text)
        code = _built_on(recording, given.on, given.application) if given.on is not None else None
    except RecordingError as error:
        raise UsageError(f"{given.recording}: {error}") from error
    if given.until_fault and recording.exception is None:
        raise UsageError(f"{given.recording}: nothing has failed in this recording; leave --until-fault out")
    result = replay_in_process(ReplayOrder(text, code, given.show, given.until))
    if result.problem is not None:
        complain(result.problem)
        return 1
    if given.on is not None:
        good = result.fault is None
    else:
        good = result.difference is None and (given.until is not None or result.same_fault)
        good = good or (given.until_fault and result.same_fault)
    if given.format == "json":
        import msgspec

        show_json({"ok": good, **msgspec.to_builtins(result)})
    else:
        _show(result, recording.application, today=given.on is not None)
    return 0 if good else 1


def recording_text(path: Path) -> str:
    """The text of a file, or of an object in a project folder. Raises UsageError."""
    from tappet.project.kinds.flight_recording import FlightRecordingData
    from tappet.project.project_file import is_project

    if path.is_file():
        try:
            return path.read_text(encoding="ascii")
        except (OSError, UnicodeDecodeError) as error:
            raise UsageError(f"{path} is no recording: {error}") from error
    folder = next((parent for parent in path.parents if is_project(parent)), None)
    if folder is None:
        raise UsageError(f"{path} is neither a file nor an object of a project folder")
    from tappet.cli.inputs import load_project

    project = load_project(folder)
    found = [item for item in project.walk() if isinstance(item.data, FlightRecordingData)]
    for item in found:
        if item.name.casefold() == path.name.casefold() and isinstance(item.data, FlightRecordingData):
            return item.data.recording
    names = ", ".join(sorted(item.name for item in found))
    raise UsageError(f"{folder} has no recording '{path.name}'; there is {names or 'none'}")


def _built_on(recording: FlightRecording, path: Path, application: str | None) -> bytes:
    """The application of a project as an online change of the recorded one. Raises UsageError,
    RecordingError."""
    import sys
    from dataclasses import replace

    from tappet.cli.inputs import applications
    from tappet.codegen.build import build_application
    from tappet.codegen.check import format_diagnostic
    from tappet.user_cache import cache_folder

    (chosen,) = applications([path], application or recording.application)
    options = replace(chosen.options, cache=cache_folder("objects"))
    result = build_application(chosen.sources, chosen.tasks, options, previous=recording.code())
    if result.package is None:
        for diagnostic in result.diagnostics:
            if diagnostic.severity == "error":
                print(format_diagnostic(diagnostic), file=sys.stderr)
        raise UsageError(f"{path} has errors, so nothing can be replayed on it")
    return result.package.to_bytes()


def _show(result: ReplayResult, application: str, *, today: bool) -> None:
    print(f"{application}: {counted(result.cycles, 'cycle')}, up to cycle {result.last_cycle}")
    for note in result.notes:
        print(f"  note: {note}")
    if not today and result.recorded is not None:
        print(f"  recorded: {_fault(result.recorded)}")
    print(f"  replayed: {_fault(result.fault) if result.fault is not None else 'no exception'}")
    if result.difference is not None:
        print(f"  differs first in cycle {result.difference.cycle}:")
        for row in result.difference.variables:
            print(f"    {row.name}: recorded {row.recorded}, replayed {row.replayed}")
    elif not today:
        print("  all variables are as recorded in every cycle")
    for expression, literal in result.values.items():
        print(f"{expression} = {literal}")


def _fault(report: ExceptionReport) -> str:
    from tappet.runtime.exception_report import summary

    return f"{summary(report)}, cycle {report.cycle}"
