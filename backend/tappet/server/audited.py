"""Routes whose acts are in the audit log before they are done, whatever becomes of them.

    @router.post("/stop")
    async def stop(link: LinkDep, act: Annotated[ActRecord, audited("stop", Role.OPERATOR)]) -> None:
        await act.begin_async(Act("stop", link.name, runtime_id=link.id))
        ...

With `always`, an act that stops something (a machine, a force, a session) is done even then: its rows are
kept in the reserve (`audit_reserve`) until the database takes them.

The dependency checks the role, as `RequireRole` does. A request that ends before `begin` is a refused row;
when the rows of `begin` cannot be stored, it raises, and nothing is done. A test fails for a route that
changes something and neither takes this dependency nor is named there with the reason.
"""

from __future__ import annotations

import logging
from collections.abc import AsyncIterator
from typing import Any

from fastapi import Depends, Request
from sqlalchemy.exc import DBAPIError
from starlette.concurrency import run_in_threadpool

from tappet.server import audit
from tappet.server.audit import Act, Result
from tappet.server.audit_reserve import AuditReserve
from tappet.server.auth import identity as identities
from tappet.server.auth.identity import Identity
from tappet.server.auth.roles import Role
from tappet.server.database import Database
from tappet.server.dependencies import identify, services_of
from tappet.server.problems import as_problem

log = logging.getLogger(__name__)


class ActRecord:
    """The rows of one request."""

    def __init__(
        self, database: Database, reserve: AuditReserve, who: Identity, *, always: bool = False
    ) -> None:
        self.who = who
        self._database = database
        self._reserve = reserve
        self._always = always
        self._kept: list[str] = []
        """Keys of rows in the reserve."""
        self._open: list[int] = []
        self._known: dict[str, str | None] = {}
        self.begun = False

    def begin(self, *acts: Act) -> None:
        """Stores what is to be done next; call it right before. Blocks. What it raises stops the act."""
        self.end(Result.OK)
        try:
            self._reserve.try_move(self._database)  # what was before stands before
            self._open = self._database.write(lambda db: audit.begin(db, self.who, *acts))
        except (DBAPIError, OSError):
            if not self._always:
                raise
            log.exception("the audit log takes no row: %s is kept in the reserve", acts)
            self._kept = self._reserve.keep(self.who, *acts)
        self.begun = True

    async def begin_async(self, *acts: Act) -> None:
        """`begin` on a thread, for coroutines."""
        await run_in_threadpool(self.begin, *acts)

    def resulted(self, **known: str | None) -> None:
        """Columns of what has begun last that are known only after it: `subject`, `project_id`, ..."""
        self._known |= known

    def end(self, result: Result, reason: str | None = None) -> None:
        """Completes what has begun. Blocks. The act is done: a full disk now changes nothing about it."""
        ids, known = self._open, self._known
        self._open, self._known = [], {}
        kept, self._kept = self._kept, []
        ids = ids + self._reserve.complete(kept, result, reason)
        if not ids:
            return
        try:
            self._database.write(lambda db: audit.complete(db, ids, result, reason, **known))
        except Exception:
            log.exception("audit rows %s stay begun; the result was: %s %s", ids, result, reason or "")

    def stop(self, error: Exception, refused: Act) -> None:
        """The request ends by `error`: the result of what had begun, else a row for `refused`. Blocks."""
        problem = as_problem(error)
        internal = problem.kind == "internal-error"
        reason = f"{type(error).__name__}: {error}" if internal else problem.detail
        if self.begun:
            self.end(Result.REFUSED if problem.status < 500 else Result.FAILED, reason)
        elif problem.kind != "invalid-request":
            audit.note_refusal(self._database, self.who, refused, reason)


class Audited:
    """Dependency: who asks, having at least `role`, and the record of what they do.

    With `quoted` a refused row holds the body of the request, which must have no secrets. With `always` the
    act is done even when the database takes no row.
    """

    def __init__(self, action: str, role: Role, *, quoted: bool = False, always: bool = False) -> None:
        self.action = action
        self.role = role
        self.quoted = quoted
        self.always = always

    async def __call__(self, request: Request) -> AsyncIterator[ActRecord]:
        """Raises 401 and 403 problems."""
        who = await identify(request)
        if who is None:
            raise identities.unauthenticated()
        services = await services_of(request)
        record = ActRecord(services.database, services.audit_reserve, who, always=self.always)
        try:
            identities.require(who, self.role)
            yield record
        except Exception as error:
            await run_in_threadpool(record.stop, error, await self._refused(request))
            raise
        await run_in_threadpool(record.end, Result.OK)
        assert record.begun, f"{self.action}: the route did what it never began"

    async def _refused(self, request: Request) -> Act:
        path = request.path_params
        body = (await request.body()).decode(errors="replace") if self.quoted else None
        return Act(
            self.action,
            request.url.path,
            new_value=body,
            project_id=path.get("project_id"),
            runtime_id=path.get("runtime_id"),
        )


def audited(action: str, role: Role, *, quoted: bool = False, always: bool = False) -> Any:
    """What a route takes its record from; the rows are complete when the answer is sent."""
    return Depends(Audited(action, role, quoted=quoted, always=always), scope="function")
