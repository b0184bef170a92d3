"""Evaluates measurements of axes as a process of its own: reads orders from its input, writes outcomes."""

from __future__ import annotations

import traceback
from dataclasses import asdict, fields
from typing import Any

import msgspec

from tappet.motion.axis_measurement import AxisFacts, FrameLayout
from tappet.motion.loop_tuning import Evaluation, Proposal, evaluate
from tappet.motion.loops import DriveLoops
from tappet.motion.measured_response import Recording, UnusableMeasurementError
from tappet.motion.recorded_axis import recorded_answer
from tappet.server.worker_loop import serve
from tappet.translation.sentences import sentence

MOST_SAMPLES = 4000
"""That are sent; of longer answers every second, third ... cycle."""


def outcome(order: dict[str, Any]) -> dict[str, Any]:
    """What is sent back."""
    try:
        return {"body": msgspec.json.encode(measured(order))}
    except Exception as error:
        traceback.print_exc()
        return {"crash": f"{type(error).__name__}: {error}"}


def measured(order: dict[str, Any]) -> dict[str, Any]:
    """The shape AxisMeasured, but for what the request said itself."""
    facts = AxisFacts(**order["facts"])
    layout = FrameLayout(tuple(order["codes"]), dict(order["phases"]))
    known: dict[str, Any] = order["known"]
    empty: dict[str, Any] = {"samples": None, "figures": None, "model": None, "proposals": []}
    try:
        recording = recorded_answer(order["cycles"], order["frames"], layout, facts)
    except UnusableMeasurementError as error:
        return known | empty | {"problem": sentence(f"{error}.", order["language"])}
    found = evaluate(recording, facts.loop, facts.largest_torque)
    problem = None if found.problem is None else sentence(f"{found.problem}.", order["language"])
    return known | _evaluated(recording, found, facts) | {"problem": problem}


def _evaluated(recording: Recording, found: Evaluation, facts: AxisFacts) -> dict[str, Any]:
    every = slice(None, None, -(-len(recording.set_position) // MOST_SAMPLES))
    names = ("time", "set_position", "act_position", "set_velocity", "act_velocity", "command", "torque")
    columns = {name: getattr(recording, name) for name in names}
    model, loop = found.identified, facts.loop
    inertia = None
    if model is not None and isinstance(loop, DriveLoops):
        inertia = model.lag_s * loop.velocity_gain
    return {
        "samples": {name: None if one is None else one[every].tolist() for name, one in columns.items()},
        "figures": None if found.figures is None else asdict(found.figures),
        "model": None
        if model is None
        else {one.name: getattr(model, one.name) for one in fields(model)}
        | {"answer": model.answer[every].tolist(), "inertia": inertia},
        "proposals": [_proposal(one, every) for one in found.proposals],
    }


def _proposal(proposal: Proposal, every: slice) -> dict[str, Any]:
    return {
        "aim": proposal.aim,
        "gains": [{"name": name, "value": value} for name, value in proposal.gains.items()],
        "phase_margin_deg": proposal.margins.phase_deg,
        "gain_margin": proposal.margins.gain,
        "answer": proposal.answer[every].tolist(),
    }


if __name__ == "__main__":
    serve(outcome)
