"""Takes a recording out of a running, stopped or failed application."""

from __future__ import annotations

import time

from tappet.runtime.application import LoadedApplication
from tappet.runtime.contexts import FAULTED
from tappet.runtime.errors import PlcError
from tappet.runtime.exception_report import ExceptionReport
from tappet.runtime.executive.records import Record
from tappet.runtime.flight_recording import (
    FlightRecording,
    RecordedCycle,
    RecordedForces,
    RecordedTask,
    RecordedValue,
    RecordedWrite,
)
from tappet.runtime.flight_tasks import TaskProgress
from tappet.runtime.forces import PlacedValue


def take_recording(application: LoadedApplication, report: ExceptionReport | None) -> FlightRecording:
    """What the flight recorder keeps now, with the code, the writes and the forces. PlcError when it keeps
    nothing."""
    recorder = application.flight
    if recorder is None:
        raise PlcError("the flight recorder is off, or the application has no task that could feed it")
    base, entries = recorder.export()
    if not entries:
        raise PlcError("the flight recorder holds no cycle: the application has not run")
    contexts, package = application.contexts, application.package
    bus = application.ownership.bus
    first = entries[0][0].cycle
    clock = contexts.application
    now = clock["virtualNow"] if application.virtual else time.clock_gettime_ns(time.CLOCK_MONOTONIC)
    unix = clock["epochOffset"] + now if application.virtual else time.time_ns()
    return FlightRecording(
        application=package.application,
        project=package.facts.project,
        code_id=package.code_id,
        data_id=package.data_id,
        saved_ns=time.time_ns(),
        package=package.to_bytes(),
        image_address=application.image.address,
        image_size=application.image.size,
        base=base,
        cycles=[RecordedCycle(e.cycle, e.timestamp_ns, e.due_ns, data, tasks) for e, data, tasks in entries],
        bus=bus,
        tasks=[
            RecordedTask(spec.name, _progress(task))
            for spec, task in zip(package.tasks, contexts.tasks, strict=True)
        ],
        start_ns=clock["startNs"],
        epoch_ns=unix - now,
        period=recorder.settings.divider,
        parts=recorder.parts,
        virtual=application.virtual,
        writes=[
            RecordedWrite(bus if write.task is None else write.task, write.batch.cycle, _values(write.values))
            for write in application.outside.writes
            if bus is not None and write.batch.cycle > 0
        ],
        forces=_forces(application, first),
        exception=report if application.tasks.state == FAULTED else None,
    )


def _progress(task: Record) -> TaskProgress:
    now = task["progress"]
    return TaskProgress(now, now, task["cycle"], task["cycleStart"], task["requested"])


def _forces(application: LoadedApplication, first: int) -> list[RecordedForces]:
    """The tables of forces that were valid since the first recorded cycle."""
    tables = [RecordedForces(f.cycle, _values(f.values)) for f in application.outside.forcings]
    before = [table for table in tables if table.cycle <= first]
    return before[-1:] + [table for table in tables if table.cycle > first]


def _values(values: tuple[PlacedValue, ...]) -> list[RecordedValue]:
    return [RecordedValue(v.place.offset, v.place.bit, v.data) for v in values]
