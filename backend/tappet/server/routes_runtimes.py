"""Runtimes: the list, state, start, stop, reset, tasks, exception, log, symbols."""

from __future__ import annotations

from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from datetime import UTC, datetime
from typing import Annotated

from fastapi import APIRouter, Query
from sqlalchemy import Connection, delete, insert

from tappet.codegen.symbol_map import SymbolError
from tappet.runtime import logbook
from tappet.runtime.tasks import TaskStatistics
from tappet.server import audit, values
from tappet.server.audit import Act
from tappet.server.auth.identity import Identity
from tappet.server.dependencies import (
    DatabaseDep,
    Engineer,
    LinkDep,
    Operator,
    RuntimesDep,
    Viewer,
)
from tappet.server.plc_client import PlcClient
from tappet.server.problems import Problem
from tappet.server.runtimes import RuntimeLink, exception_state
from tappet.server.schemas.runtimes import (
    LogEntry,
    NewRuntime,
    ResetOrder,
    RuntimeException,
    RuntimeState,
    Symbol,
    TaskState,
)
from tappet.server.settings import LOCAL_RUNTIME
from tappet.server.source_places import SourcePlaces, shown_line
from tappet.server.tables import runtimes as table

router = APIRouter(prefix="/runtimes", tags=["runtimes"])


@router.get("")
async def list_runtimes(who: Viewer, runtimes: RuntimesDep) -> list[RuntimeState]:
    """All runtimes with their state."""
    return [link.state() for link in runtimes.all()]


@router.post("", status_code=201)
async def add_runtime(
    body: NewRuntime, who: Engineer, runtimes: RuntimesDep, database: DatabaseDep
) -> RuntimeState:
    """Add a running soft PLC; the server keeps connected to it from now on."""
    if any(link.name.casefold() == body.name.casefold() for link in runtimes.all()):
        raise Problem(409, "name-taken", f"There already is a runtime '{body.name}'.")
    link = runtimes.add(body.name, body.url, body.token)

    def store(db: Connection) -> None:
        db.execute(
            insert(table).values(
                id=link.id, name=body.name, url=body.url, token=body.token, created_at=datetime.now(UTC)
            )
        )
        audit.record(db, who, Act("runtime-added", body.name, new_value=body.url, runtime_id=link.id))

    await database.write_async(store)
    return link.state()


@router.get("/{runtime_id}")
async def get_runtime(who: Viewer, link: LinkDep) -> RuntimeState:
    """State of one runtime."""
    return link.state()


@router.delete("/{runtime_id}", status_code=204)
async def remove_runtime(who: Engineer, link: LinkDep, runtimes: RuntimesDep, database: DatabaseDep) -> None:
    """Forget a runtime; the soft PLC itself goes on running."""
    if link.id == LOCAL_RUNTIME:
        raise Problem(409, "local-runtime", "The local runtime belongs to this server and cannot be removed.")

    def forget(db: Connection) -> None:
        db.execute(delete(table).where(table.c.id == link.id))
        audit.record(db, who, Act("runtime-removed", link.name, old_value=link.url, runtime_id=link.id))

    await database.write_async(forget)
    await runtimes.remove(link.id)


@asynccontextmanager
async def _acting(
    link: RuntimeLink, database: DatabaseDep, who: Identity, kind: str
) -> AsyncIterator[PlcClient]:
    """What is done inside to the loaded application is recorded; then its state is known."""
    link.loaded_symbols()
    async with link.client() as client:
        yield client
    await link.refresh()
    act = Act(kind, link.name, runtime_id=link.id)
    await database.write_async(lambda db: audit.record(db, who, act))


@router.post("/{runtime_id}/start")
async def start(who: Operator, link: LinkDep, database: DatabaseDep) -> RuntimeState:
    """Start the application."""
    async with _acting(link, database, who, "start") as client:
        await client.start()
    return link.state()


@router.post("/{runtime_id}/stop")
async def stop(who: Operator, link: LinkDep, database: DatabaseDep) -> RuntimeState:
    """Stop the application; its outputs go to their safe values."""
    async with _acting(link, database, who, "stop") as client:
        await client.stop()
    return link.state()


@router.post("/{runtime_id}/single-cycle")
async def single_cycle(who: Operator, link: LinkDep, database: DatabaseDep) -> RuntimeState:
    """Run one cycle of each cyclic and freewheeling task of a stopped application."""
    async with _acting(link, database, who, "single-cycle") as client:
        await client.single_cycle()
    return link.state()


@router.post("/{runtime_id}/reset")
async def reset(body: ResetOrder, who: Engineer, link: LinkDep, database: DatabaseDep) -> RuntimeState:
    """Initialise the variables: warm (not RETAIN), cold (not PERSISTENT), origin (all, and unload)."""
    async with _acting(link, database, who, f"reset-{body.kind}") as client:
        await client.reset(body.kind)
    return link.state()


@router.get("/{runtime_id}/tasks")
async def list_tasks(who: Viewer, link: LinkDep) -> list[TaskState]:
    """Statistics of all tasks."""
    async with link.client() as client:
        return [_task(task) for task in await client.tasks()]


@router.post("/{runtime_id}/tasks/{task}/reset", status_code=204)
async def reset_task_statistics(task: str, who: Operator, link: LinkDep) -> None:
    """Begin the statistics of a task anew."""
    async with link.client() as client:
        known = [t.name for t in await client.tasks()]
        if task not in known:
            raise Problem(404, "not-found", f"There is no task '{task}'; there are {', '.join(known)}.")
        await client.reset_statistics(task)


@router.get("/{runtime_id}/exception")
async def get_exception(who: Viewer, link: LinkDep) -> RuntimeException | None:
    """Why the application stopped, with call stack and values; null when it did not."""
    async with link.client() as client:
        report = await client.exception()
    return exception_state(report, link.places) if report is not None else None


@router.get("/{runtime_id}/log")
async def read_log(
    who: Viewer,
    link: LinkDep,
    since: Annotated[int, Query(ge=0, description="Id of the last known line.")] = 0,
) -> list[LogEntry]:
    """Lines of the runtime's log after `since`, oldest first."""
    async with link.client() as client:
        return [_log_entry(entry, link.places) for entry in await client.log(since)]


@router.get("/{runtime_id}/symbols")
async def browse_symbols(
    who: Viewer, link: LinkDep, path: Annotated[str, Query(max_length=500)] = ""
) -> list[Symbol]:
    """Variables below a path of the loaded application; programs and variable lists for an empty one."""
    symbols = link.loaded_symbols()
    try:
        children = symbols.children(path)
    except SymbolError as error:
        raise Problem(404, "unknown-expression", values.explain(symbols, path, error)) from None
    return [Symbol(name=c.name, path=c.path, type=c.type, kind=c.kind, leaf=c.leaf) for c in children]


def _log_entry(entry: logbook.LogEntry, places: SourcePlaces | None) -> LogEntry:
    """The line as the log shows it; a place in a program is told as the editor counts lines."""
    line = shown_line(places, entry.uri, entry.line)
    return LogEntry(
        id=entry.number,
        at=datetime.fromtimestamp(entry.timestamp_ns / 1e9, UTC),
        severity=entry.severity,
        component=entry.component,
        message=f"{entry.message}, line {line}" if line else entry.message,
    )


def _task(task: TaskStatistics) -> TaskState:
    def us(ns: int) -> float:
        return round(ns / 1000, 3)

    return TaskState(
        name=task.name,
        kind=task.kind,
        priority=task.priority,
        status=task.status,
        interval_us=us(task.interval_ns),
        iec_cycles=task.iec_cycles,
        cycles=task.cycles,
        last_us=us(task.last_ns),
        average_us=us(task.average_ns),
        min_us=us(task.min_ns),
        max_us=us(task.max_ns),
        jitter_us=us(task.jitter_ns),
        min_jitter_us=us(task.jitter_min_ns),
        max_jitter_us=us(task.jitter_max_ns),
        average_jitter_us=us(task.jitter_average_ns),
        p999_jitter_us=us(task.jitter_p999_ns),
        overruns=task.overruns,
        missed=task.missed,
    )
