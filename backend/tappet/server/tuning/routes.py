"""Measurements of position loops, and the gains that follow from them."""

from __future__ import annotations

from typing import Annotated

from fastapi import Path
from fastapi.responses import Response

from tappet.project.naming import MAX_NAME
from tappet.server.audit import Act
from tappet.server.audited import ActRecord, audited
from tappet.server.auth.roles import Role
from tappet.server.dependencies import LinkDep, ServicesDep, Viewer
from tappet.server.routing import Router
from tappet.server.spoken import LanguageDep
from tappet.server.tuning.service import MeasuredAxis, Measuring
from tappet.server.tuning.shapes import AxisMeasured, AxisTuning, MeasureOrder, TuningGain

router = Router(prefix="/runtimes/{runtime_id}/axes/{axis}/tuning", tags=["axes"])
AxisName = Annotated[str, Path(pattern="^[A-Za-z_][A-Za-z0-9_]*$", max_length=MAX_NAME)]


@router.get("")
async def get_axis_tuning(axis: AxisName, who: Viewer, link: LinkDep) -> AxisTuning:
    """The gains of an axis as they are, and a measurement that fits its limits.

    An axis whose loop is closed elsewhere, or nowhere, is the problem `no-position-loop`.
    """
    facts = await MeasuredAxis(link, axis).facts()
    return AxisTuning(
        closed_in="drive" if facts.in_drive else "controller",
        state=facts.state,
        bus_task=facts.bus_task,
        cycle_s=facts.values["fTaskCycle"],
        gains=[
            TuningGain(name=name, expression=expression, value=value)
            for name, (expression, value) in facts.gains.items()
        ],
        lag_limit=facts.lag_limit,
        excitation=facts.excitation,
        height=facts.suggested_height,
        duration_s=facts.suggested_duration_s,
    )


@router.post("/measure", response_model=AxisMeasured)
async def measure_axis(
    axis: AxisName,
    body: MeasureOrder,
    act: Annotated[ActRecord, audited("axis-measured", Role.OPERATOR, quoted=True)],
    link: LinkDep,
    services: ServicesDep,
    language: LanguageDep,
) -> Response:
    """Measure an axis that one controls (`/panel`), and answer with what it says when it is back.

    The controller makes the step or the fast move and brings the axis back. Keep saying that one is there
    (`/panel/alive`); `/panel/stop` ends it at any time. A height beyond a limit is the problem
    `measurement-refused`, an early end `measurement-interrupted`. For bad data the answer has `problem`
    instead of proposals.
    """
    measured = MeasuredAxis(link, axis)
    facts = await measured.facts()

    async def begin() -> None:
        what = f"{body.excitation} {body.height} u, {body.duration_s} s"
        await act.begin_async(Act("axis-measured", axis, None, what, None, link.id))

    order = Measuring(body.holder, body.excitation, body.height, body.duration_s)
    frames = await measured.measure(order, facts, begin)
    known = {
        "axis": axis,
        "closed_in": "drive" if facts.in_drive else "controller",
        "excitation": body.excitation,
        "height": body.height,
        "cycle_s": facts.values["fTaskCycle"],
    }
    answer = await services.evaluator.ask(known, frames, measured.layout, facts, language)
    return Response(answer, media_type="application/json")
