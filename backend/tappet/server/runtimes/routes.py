"""Runtimes: the list, state, symbols. What a runtime does is in its operations."""

from __future__ import annotations

from datetime import UTC, datetime
from typing import Annotated

from fastapi import APIRouter, Query
from sqlalchemy import Connection, delete, insert

from tappet.codegen.symbol_map import SymbolError
from tappet.server import audit
from tappet.server.audit import Act
from tappet.server.dependencies import (
    DatabaseDep,
    Engineer,
    LinkDep,
    RuntimesDep,
    Viewer,
)
from tappet.server.problems import Problem
from tappet.server.runtimes.shapes import (
    NewRuntime,
    RuntimeState,
    Symbol,
)
from tappet.server.settings import LOCAL_RUNTIME
from tappet.server.tables import runtimes as table
from tappet.server.values import service as values

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
    """Forget a runtime; the soft PLC itself continues to run."""
    if link.id == LOCAL_RUNTIME:
        raise Problem(409, "local-runtime", "The local runtime belongs to this server and cannot be removed.")

    def forget(db: Connection) -> None:
        db.execute(delete(table).where(table.c.id == link.id))
        audit.record(db, who, Act("runtime-removed", link.name, old_value=link.url, runtime_id=link.id))

    await database.write_async(forget)
    await runtimes.remove(link.id)


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
    return [Symbol.of(child) for child in children]
