"""Values of running applications: read, write, force, release."""

from __future__ import annotations

from fastapi import APIRouter

from tappet.server import audit
from tappet.server.audit import Act
from tappet.server.auth.identity import Identity
from tappet.server.database import Database
from tappet.server.dependencies import DatabaseDep, LinkDep, Operator, Viewer
from tappet.server.values import service as values
from tappet.server.values.service import Written
from tappet.server.values.shapes import Forces, ReadOrder, UnforceOrder, Values, WriteOrder

router = APIRouter(prefix="/runtimes/{runtime_id}", tags=["values"])


async def _log(
    database: Database, who: Identity, action: str, runtime_id: str, written: list[Written]
) -> None:
    acts = [Act(action, w.path, w.old_literal, w.new_literal or None, runtime_id=runtime_id) for w in written]
    await database.write_async(lambda db: audit.record(db, who, *acts))


@router.post("/values/read")
async def read_values(body: ReadOrder, who: Viewer, link: LinkDep) -> Values:
    """Read values of one moment. An unknown expression carries its own error, the others are read."""
    return Values(values=await values.read(link, body.expressions))


@router.post("/values/write")
async def write_values(body: WriteOrder, who: Operator, link: LinkDep, database: DatabaseDep) -> Values:
    """Write values together at the beginning of a cycle, all or none; answers with what is there then."""
    written = await values.write(link, body.values)
    await _log(database, who, "write", link.id, written)
    return Values(values=await values.read(link, [v.expression for v in body.values]))


@router.post("/values/force")
async def force_values(body: WriteOrder, who: Operator, link: LinkDep, database: DatabaseDep) -> Forces:
    """Hold variables at values until they are released; answers with all forces."""
    written = await values.force(link, body.values)
    await _log(database, who, "force", link.id, written)
    return Forces(values=await values.forces(link))


@router.post("/values/unforce")
async def unforce_values(body: UnforceOrder, who: Operator, link: LinkDep, database: DatabaseDep) -> Forces:
    """Release forced variables, or all of them; answers with the forces that remain."""
    released = await values.unforce(link, body.expressions, restore=body.restore)
    await _log(database, who, "unforce", link.id, released)
    return Forces(values=await values.forces(link))


@router.get("/forces")
async def list_forces(who: Viewer, link: LinkDep) -> Forces:
    """All forced variables with the values they are held at."""
    return Forces(values=await values.forces(link))
