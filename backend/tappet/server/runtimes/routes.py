"""Runtimes: the list, state, symbols. What a runtime does is in its operations."""

from __future__ import annotations

import uuid
from datetime import UTC, datetime
from typing import Annotated

from fastapi import Query
from sqlalchemy import delete, insert

from tappet.codegen.symbol_map import SymbolError
from tappet.server.audit import Act
from tappet.server.audited import ActRecord, audited
from tappet.server.auth.roles import Role
from tappet.server.dependencies import (
    DatabaseDep,
    LinkDep,
    RuntimesDep,
    Viewer,
)
from tappet.server.problems import Problem
from tappet.server.routing import Router
from tappet.server.runtimes.shapes import (
    NewRuntime,
    RuntimeState,
    Symbol,
)
from tappet.server.settings import LOCAL_RUNTIME
from tappet.server.spoken import LanguageDep, in_language
from tappet.server.tables import runtimes as table
from tappet.server.values import service as values

router = Router(prefix="/runtimes", tags=["runtimes"])


@router.get("")
async def list_runtimes(who: Viewer, runtimes: RuntimesDep, language: LanguageDep) -> list[RuntimeState]:
    """All runtimes with their state."""
    return in_language([link.state() for link in runtimes.all()], language)


@router.post("", status_code=201)
async def add_runtime(
    act: Annotated[ActRecord, audited("runtime-added", Role.ENGINEER)],
    body: NewRuntime,
    runtimes: RuntimesDep,
    database: DatabaseDep,
) -> RuntimeState:
    """Add a running soft PLC; the server keeps connected to it from now on."""
    if any(link.name.casefold() == body.name.casefold() for link in runtimes.all()):
        raise Problem(409, "name-taken", f"There already is a runtime '{body.name}'.")
    runtime_id = uuid.uuid4().hex
    await act.begin_async(Act("runtime-added", body.name, new_value=body.url, runtime_id=runtime_id))
    row = {"id": runtime_id, "name": body.name, "url": body.url, "token": body.token}
    await database.write_async(
        lambda db: db.execute(insert(table).values(row | {"created_at": datetime.now(UTC)}))
    )
    return runtimes.add(body.name, body.url, body.token, runtime_id).state()


@router.get("/{runtime_id}")
async def get_runtime(who: Viewer, link: LinkDep, language: LanguageDep) -> RuntimeState:
    """State of one runtime."""
    return in_language(link.state(), language)


@router.delete("/{runtime_id}", status_code=204)
async def remove_runtime(
    act: Annotated[ActRecord, audited("runtime-removed", Role.ENGINEER)],
    link: LinkDep,
    runtimes: RuntimesDep,
    database: DatabaseDep,
) -> None:
    """Forget a runtime; the soft PLC itself continues to run."""
    if link.id == LOCAL_RUNTIME:
        raise Problem(409, "local-runtime", "The local runtime belongs to this server and cannot be removed.")
    await act.begin_async(Act("runtime-removed", link.name, old_value=link.url, runtime_id=link.id))
    await database.write_async(lambda db: db.execute(delete(table).where(table.c.id == link.id)))
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
