"""Values of running applications: read, write, force, release."""

from __future__ import annotations

from typing import Annotated

from fastapi import Request

from tappet.server.audit import Act
from tappet.server.audited import ActRecord, audited
from tappet.server.auth.roles import Role
from tappet.server.auth.sent_from import sent_from
from tappet.server.dependencies import LinkDep, Viewer
from tappet.server.routing import Router
from tappet.server.runtimes.links import RuntimeLink
from tappet.server.spoken import LanguageDep, in_language
from tappet.server.values import service as values
from tappet.server.values.service import Written
from tappet.server.values.shapes import Forces, ReadOrder, UnforceOrder, Values, WriteOrder

router = Router(prefix="/runtimes/{runtime_id}", tags=["values"])


def _recording(act: ActRecord, action: str, link: RuntimeLink) -> values.Begin:
    """Records each value as an act of its own, before the values are sent."""

    async def begin(written: list[Written]) -> None:
        rows = [Act(action, w.path, w.old_literal, w.new_literal or None, None, link.id) for w in written]
        await act.begin_async(*rows or [Act(action, "nothing", runtime_id=link.id)])

    return begin


@router.post("/values/read")
async def read_values(body: ReadOrder, who: Viewer, link: LinkDep, language: LanguageDep) -> Values:
    """Read values of one moment. An unknown expression carries its own error, the others are read."""
    return in_language(Values(values=await values.read(link, body.expressions)), language)


@router.post("/values/write")
async def write_values(
    act: Annotated[ActRecord, audited("write", Role.OPERATOR, quoted=True)],
    body: WriteOrder,
    link: LinkDep,
) -> Values:
    """Write values together at the beginning of a cycle, all or none; answers with what is there then."""
    await values.write(link, body.values, _recording(act, "write", link))
    return Values(values=await values.read(link, [v.expression for v in body.values]))


@router.post("/values/force")
async def force_values(
    act: Annotated[ActRecord, audited("force", Role.OPERATOR, quoted=True)],
    request: Request,
    body: WriteOrder,
    link: LinkDep,
) -> Forces:
    """Hold variables at values until they are released; answers with all forces."""
    begin = _recording(act, "force", link)
    await values.force(link, body.values, begin, user=act.who.username, place=sent_from(act.who, request))
    return Forces(values=await values.forces(link))


@router.post("/values/unforce")
async def unforce_values(
    act: Annotated[ActRecord, audited("unforce", Role.OPERATOR, quoted=True, always=True)],
    body: UnforceOrder,
    link: LinkDep,
) -> Forces:
    """Release forced variables, or all of them; answers with the forces that remain."""
    begin = _recording(act, "unforce", link)
    await values.unforce(link, body.expressions, begin, restore=body.restore)
    return Forces(values=await values.forces(link))


@router.get("/forces")
async def list_forces(who: Viewer, link: LinkDep) -> Forces:
    """All forced variables with the values they are held at."""
    return Forces(values=await values.forces(link))
