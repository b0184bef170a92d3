"""Downloads in the audit log."""

from __future__ import annotations

from tappet.server.audit import Act
from tappet.server.audited import ActRecord
from tappet.server.builds.builder import Built
from tappet.server.builds.commissioning import Begin, Step
from tappet.server.runtimes.links import RuntimeLink


def recording(act: ActRecord, project_id: str, link: RuntimeLink) -> Begin:
    """Stores each step of a download before it is taken: the code that was there, and the new one."""
    old = link.info.code_id if link.info is not None else None

    async def begin(step: Step, built: Built) -> None:
        name, code_id = built.application.name, built.report.code_id
        values = (None, None) if step in ("start", "reset_origin") else (old, code_id)
        await act.begin_async(Act(step.replace("_", "-"), name, *values, project_id, link.id))

    return begin
