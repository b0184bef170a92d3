"""The position loop of an axis is measured over REST: nothing is replaced but the clock's patience."""

from __future__ import annotations

import threading
from collections.abc import AsyncIterator, Awaitable, Iterator, Sequence
from contextlib import asynccontextmanager, contextmanager
from types import SimpleNamespace
from typing import Any

import pytest
from fastapi import FastAPI
from server_clients import CHEAP, RUNTIME, connected, real_app, serving, until

from tappet.codegen.symbol_map import SymbolMap
from tappet.runtime.client import RuntimeRefused
from tappet.runtime.operations.values import Read
from tappet.server.settings import LOCAL_RUNTIME, ServerSettings
from tappet.server.tuning.service import MeasuredAxis, Measuring

ME, ANOTHER = 5, 6
BODY = """Spindle.in.bRegulatorRealState := Spindle.out.bRegulatorOn;
Spindle.in.bDriveStartRealState := Spindle.out.bDriveStart;
fSpeed := fSpeed + 0.4 * (DINT_TO_LREAL(Spindle.out.diSetVelocity) / 32.767 - fSpeed);
fPlace := fPlace + 0.004 * fSpeed;
Spindle.in.dwActPosition := DINT_TO_DWORD(LREAL_TO_DINT(fPlace * 65536.0 / 360.0));"""
DECLARATION = "PROGRAM PLC_PRG\nVAR\n    fSpeed : LREAL;\n    fPlace : LREAL;\nEND_VAR"


@pytest.fixture(scope="module")
def machine(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Machine]:
    app = real_app(ServerSettings(data_dir=tmp_path_factory.mktemp("tuning"), password_cost=CHEAP))
    with serving(app):
        yield Machine(app)


class Machine:
    """A motion project with an axis of each kind, running."""

    def __init__(self, app: FastAPI) -> None:
        self.client = client = connected(app)
        self.runtimes = app.state.services.runtimes
        store = app.state.services.store
        info = store.create_project("Tuned", "ann")
        project = store.load(info.id)
        application = project.applications()[0]
        objects = f"/api/v1/projects/{info.id}/objects"
        pool = self._add(objects, {"parent_id": application.id, "kind": "axis_pool"})
        for name, drive in (
            ("Servo", "SM_Drive_Simulated"),
            ("Spindle", "SM_Drive_PosControl"),
            ("Ghost", "SM_Drive_Virtual"),
        ):
            axis = {"parent_id": pool, "kind": "axis", "name": name, "subkind": drive}
            self._add(objects, axis)
        for item in store.load(info.id).objects.values():
            if item.name == "PLC_PRG":
                data = {"declaration": DECLARATION, "implementation": BODY}
                store.save(info.id, item.id, item.revision, data, "ann")
            if item.kind == "task":
                data = item.data.model_dump(mode="json") | {"interval": "T#4ms"}
                store.save(info.id, item.id, item.revision, data, "ann")
        url = f"/api/v1/projects/{info.id}/applications/{application.id}"
        order = {"runtime_id": LOCAL_RUNTIME, "mode": "download", "start": True}
        done = client.post(f"{url}/download", json=order)
        assert done.status_code == 200, done.text

    def _add(self, objects: str, body: dict[str, Any]) -> str:
        made = self.client.post(objects, json=body)
        assert made.status_code == 201, made.text
        return str(made.json()["id"])

    def value(self, path: str) -> Any:
        answer = self.client.post(f"{RUNTIME}/values/read", json={"expressions": [path]})
        return answer.json()["values"][0]["value"]

    def write(self, path: str, value: Any) -> None:
        body = {"values": [{"expression": path, "value": value}]}
        assert self.client.post(f"{RUNTIME}/values/write", json=body).status_code == 200

    def steer(self, axis: str, action: str) -> None:
        answer = self.client.post(f"{RUNTIME}/axes/{axis}/panel", json={"holder": ME, "action": action})
        assert answer.status_code == 200, answer.text

    @contextmanager
    def controlled(self, axis: str) -> Iterator[threading.Event]:
        """With power, by a page that says again and again that it is there; the event ends that."""
        panel, gone = f"{RUNTIME}/axes/{axis}/panel", threading.Event()

        def beat() -> None:
            while not gone.wait(0.2):
                self.client.post(f"{panel}/alive", json={"holder": ME})

        self.steer(axis, "take")
        thread = threading.Thread(target=beat)
        thread.start()
        try:
            until(
                lambda: self.client.post(f"{panel}/alive", json={"holder": ME}).json()["state"] == "Control"
            )
            self.steer(axis, "power_on")
            until(lambda: self.client.get(f"{RUNTIME}/axes/{axis}/tuning").json()["state"] == "standstill")
            yield gone
        finally:
            gone.set()
            thread.join()
            self.client.post(f"{panel}/stop", json={"holder": ME, "release": True})
            until(lambda: self.client.post(f"{panel}/alive", json={"holder": ME}).json()["state"] == "Free")

    def measure(self, axis: str, **order: Any) -> Any:
        return self.client.post(f"{RUNTIME}/axes/{axis}/tuning/measure", json={"holder": ME, **order})


def test_a_step_of_a_simulated_drive_gives_gains(machine: Machine) -> None:
    tuning = machine.client.get(f"{RUNTIME}/axes/Servo/tuning").json()
    assert tuning["closed_in"] == "drive"
    assert (tuning["bus_task"], tuning["cycle_s"]) == ("MainTask", 0.004)
    assert {one["name"]: one["value"] for one in tuning["gains"]} == {
        "position_gain": 60.0,
        "velocity_gain": 0.03,
        "integral_time": 0.02,
    }
    assert tuning["excitation"] == "step"
    with machine.controlled("Servo"):
        answer = machine.measure("Servo", height=tuning["height"], duration_s=0.4)
        assert answer.status_code == 200, answer.text
        measured = answer.json()
        assert measured["problem"] is None
        samples = measured["samples"]
        assert len(samples["time"]) == pytest.approx(125, abs=3)
        assert samples["set_position"][-1] == pytest.approx(tuning["height"])
        assert samples["act_position"][-1] == pytest.approx(tuning["height"], rel=0.02)
        assert max(map(abs, samples["torque"])) > 0
        assert samples["command"] is None
        assert measured["figures"]["dead_time_cycles"] in (1, 2)
        assert measured["model"]["inertia"] == pytest.approx(6e-5, rel=0.15)
        gentle, fast = measured["proposals"]
        assert (gentle["aim"], fast["aim"]) == ("no_overshoot", "fast")
        assert len(gentle["answer"]) == len(samples["time"])
        assert gentle["phase_margin_deg"] > 60
        for gain in gentle["gains"]:
            machine.write(
                next(one["expression"] for one in tuning["gains"] if one["name"] == gain["name"]),
                gain["value"],
            )
        now = machine.client.get(f"{RUNTIME}/axes/Servo/tuning").json()
        assert {one["name"]: one["value"] for one in now["gains"]} == {
            one["name"]: pytest.approx(one["value"]) for one in gentle["gains"]
        }
    acts = [
        entry for entry in machine.client.get("/api/v1/audit").json() if entry["action"] == "axis-measured"
    ]
    assert ("Servo", "ok") in {(entry["subject"], entry["result"]) for entry in acts}


def test_an_axis_without_a_gain_is_measured_by_a_fast_move(machine: Machine) -> None:
    tuning = machine.client.get(f"{RUNTIME}/axes/Spindle/tuning").json()
    assert (tuning["closed_in"], tuning["excitation"]) == ("controller", "move")
    with machine.controlled("Spindle"):
        measured = machine.measure("Spindle", excitation="move", height=5.0, duration_s=0.5).json()
        assert measured["problem"] is None
        assert measured["model"]["factor"] == pytest.approx(1.0, abs=0.02)
        assert {one["name"] for one in measured["proposals"][0]["gains"]} == {"position_gain", "dead_time"}
        step = machine.measure("Spindle", height=5.0, duration_s=0.3).json()
        assert step["proposals"] == []
        assert "did not follow the set position" in step["problem"]
        chinese = machine.client.post(
            f"{RUNTIME}/axes/Spindle/tuning/measure",
            json={"holder": ME, "height": 5.0, "duration_s": 0.3},
            headers={"Accept-Language": "zh"},
        ).json()
        assert "轴没有跟随设定位置" in chinese["problem"]


def test_what_must_not_be_measured_is_refused(machine: Machine) -> None:
    refused = machine.client.get(f"{RUNTIME}/axes/Ghost/tuning")
    assert (refused.status_code, refused.json()["type"]) == (409, "urn:tappet:problem:no-position-loop")
    assert machine.client.get(f"{RUNTIME}/axes/Nobody/tuning").status_code == 404
    off = machine.measure("Servo", height=5.0)
    assert off.status_code == 409
    assert "is in the state power_off" in off.json()["detail"]
    assert machine.measure("Servo", height="far").status_code == 422
    assert machine.measure("Servo", height=5.0, duration_s=60).status_code == 422
    with machine.controlled("Servo"):
        order = {"holder": ANOTHER, "height": 5.0}
        other = machine.client.post(f"{RUNTIME}/axes/Servo/tuning/measure", json=order)
        assert other.json()["type"] == "urn:tappet:problem:no-control"
        far = machine.measure("Servo", height=100_000.0)
        assert far.json()["type"] == "urn:tappet:problem:measurement-refused"
        assert machine.value("IoConfig_AxisPanels.Servo.ePhase") in ("Idle", 0)


@pytest.mark.parametrize("how", ["gone", "stop"])
def test_a_measurement_that_is_interrupted_says_so(machine: Machine, how: str) -> None:
    """The page goes, or its stop button is pressed, while the axis answers."""
    answers: list[Any] = []
    with machine.controlled("Servo") as gone:
        thread = threading.Thread(
            target=lambda: answers.append(machine.measure("Servo", height=5.0, duration_s=9.0))
        )
        thread.start()
        until(lambda: machine.value("IoConfig_AxisPanels.Servo.ePhase") in ("Responding", 2))
        if how == "gone":
            gone.set()
        else:
            machine.client.post(f"{RUNTIME}/axes/Servo/panel/stop", json={"holder": ME})
        thread.join(30)
        (answer,) = answers
        assert answer.status_code == 409
        assert answer.json()["type"] == "urn:tappet:problem:measurement-interrupted"
        assert ("Control of the axis was lost" if how == "gone" else "was stopped") in answer.json()["detail"]
        assert machine.value("IoConfig_Globals.Servo.fSetVelocity") == 0.0
        if how == "gone":
            until(lambda: machine.value("IoConfig_AxisPanels.Servo.eState") in ("Free", 0))
            assert machine.value("IoConfig_Globals.Servo.bRegulatorOn") is False


class ChangedRuntime:
    """A link and its runtime: an online change came, which the link has not heard of yet."""

    def __init__(self, symbols: SymbolMap) -> None:
        self._symbols = symbols
        self.code_id = self.loaded = "first"

    def loaded_symbols(self) -> SymbolMap:
        return self._symbols

    @asynccontextmanager
    async def client(self) -> AsyncIterator[ChangedRuntime]:
        yield self

    async def call(self, order: Any) -> Any:
        if not isinstance(order, Read):
            return SimpleNamespace(state="Control", holder=ME)
        self._check(order.code_id)
        return [bytes(size) for _, size in order.places]

    async def record(
        self, items: Sequence[Any], task: str | None, divider: int, min_interval_ns: int, *, code_id: str = ""
    ) -> Any:
        self._check(code_id)
        return self

    def __aiter__(self) -> ChangedRuntime:
        return self

    async def __anext__(self) -> Any:
        raise StopAsyncIteration

    async def close(self) -> None: ...

    def _check(self, code_id: str) -> None:
        if code_id not in ("", self.loaded):
            raise RuntimeRefused("refused", "the application was changed meanwhile")


@pytest.mark.parametrize("when", ["facts", "record", "end"])
async def test_places_of_an_application_are_not_those_of_another_one(machine: Machine, when: str) -> None:
    """Nothing is read or recorded there, and the axis does not move for a record that would be wrong."""
    runtime = ChangedRuntime(machine.runtimes.get(LOCAL_RUNTIME).loaded_symbols())
    axis = MeasuredAxis(runtime, "Servo")  # type: ignore[arg-type]
    facts: Any = SimpleNamespace(check=lambda height, excitation: None, bus_task="MainTask")
    begun: list[str] = []

    async def begin() -> None:
        begun.append(runtime.loaded)
        runtime.loaded = "second"

    if when != "end":
        runtime.loaded = "second"
    order = Measuring(ME, "step", 5.0, 0.1)
    asking: Awaitable[Any] = axis.facts() if when == "facts" else axis.measure(order, facts, begin)
    with pytest.raises(RuntimeRefused, match="changed meanwhile"):
        await asking
    assert begun == (["first"] if when == "end" else [])
