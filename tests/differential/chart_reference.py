"""The reference for charts: the model of language_sfc.md, section 6, phase by phase; one call of `Run.call`
is one call of the POU. Actions are controlled by the blocks of IEC 61131-3, ACTION_CONTROL.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from chart_tree import Chart, Condition, Step


@dataclass
class OnDelay:
    """TON."""

    since: int | None = None

    def __call__(self, on: bool, time: int, now: int) -> bool:
        self.since = (now if self.since is None else self.since) if on else None
        return self.since is not None and now - self.since >= time


@dataclass
class Control:
    """ACTION_CONTROL."""

    set_: bool = False
    pulse: bool = False
    sd_set: bool = False
    ds_set: bool = False
    sl_set: bool = False
    timers: dict[str, OnDelay] = field(default_factory=lambda: {q: OnDelay() for q in TIMED})
    active: bool = False
    executed: bool = False

    def __call__(self, on: set[str], times: dict[str, int], now: int) -> bool:
        """Q."""
        reset = "R" in on

        def timer(name: str, start: bool) -> bool:
            return self.timers[name](start, times.get(name, 0), now)

        def latch(start: bool, stored: bool) -> bool:
            return start or (not reset and stored)

        self.set_ = latch("S" in on, self.set_)
        limited = "L" in on and not timer("L", True)
        if "L" not in on:
            timer("L", False)
        delayed = timer("D", "D" in on)
        pulse = "P" in on and not self.pulse
        self.pulse = "P" in on
        self.sd_set = latch("SD" in on, self.sd_set)
        stored_delayed = timer("SD", self.sd_set)
        self.ds_set = latch(timer("DS", "DS" in on), self.ds_set)
        self.sl_set = latch("SL" in on, self.sl_set)
        stored_limited = self.sl_set and not timer("SL", True)
        if not self.sl_set:
            timer("SL", False)
        some = ("N" in on, self.set_, limited, delayed, pulse, stored_delayed, self.ds_set, stored_limited)
        return not reset and any(some)


TIMED = ("L", "D", "SD", "DS", "SL")


@dataclass
class State:
    """A step."""

    x: bool = False
    next_x: bool = False
    since: int = 0
    age: int = 0
    entered: bool = False
    left: bool = False
    will_enter: bool = False
    will_leave: bool = False


class Run:
    """One instance of a chart."""

    def __init__(self, chart: Chart) -> None:
        self.chart = chart
        self.flags = {**dict.fromkeys(chart.flags, False), **dict.fromkeys(chart.inputs, False)}
        self.log, self.n, self.asked = 0, 0, [0] * 8
        self.outputs: dict[str, bool | str] = {
            f: "" if f in ("SFCCurrentStep", "SFCErrorStep") else False for f in chart.outputs
        }
        self.quit = False
        self.tip = self.tip_before = False
        self.names = sorted({a.action for s in chart.steps for a in s.associations}, key=str.upper)
        self.started = False
        self._initialise()

    def _initialise(self) -> None:
        self.states = {s.name: State() for s in self.chart.steps}
        self.controls = {name: Control() for name in self.names}
        self.tip_before = False
        for name in self.chart.flags:
            if name in self.controls:
                self.flags[name] = False
        first = self.states[self.chart.steps[0].name]
        first.next_x = first.will_enter = True

    def _reset_flags(self) -> None:
        for name in ("SFCTrans", "SFCError"):
            if name in self.outputs:
                self.outputs[name] = False
        if "SFCErrorStep" in self.outputs:
            self.outputs["SFCErrorStep"] = ""

    def call(self, r: int, now: int) -> None:
        """One call with an input at a time in milliseconds."""
        self.r, self.now = r, now
        given = {name: bool(r >> a & 1 and r >> b & 1) for name, (a, b) in self.chart.inputs.items()}
        self.flags.update(given)
        if "SFCTrans" in self.outputs:
            self.outputs["SFCTrans"] = False
        if given.get("SFCInit"):
            self._initialise()
            self._reset_flags()
            self._drop(given, "SFCInit")
            first = self.states[self.chart.steps[0].name]
            first.x, first.since = True, now
            self._name_current()
            return
        if given.get("SFCReset"):
            self._initialise()
            self._reset_flags()
            self._drop(given, "SFCReset")
        if given.get("SFCQuitError"):
            self.outputs["SFCError"] = False
            if "SFCErrorStep" in self.outputs:
                self.outputs["SFCErrorStep"] = ""
            self.quit = True
            return
        if self.quit:
            self.quit = False
            for state in self.states.values():
                state.since = now
        if given.get("SFCPause"):
            return
        self.tip = given.get("SFCTip", False) and not self.tip_before
        self.tip_before = given.get("SFCTip", False)
        self._steps()
        self._actions()
        self._transitions()

    def _drop(self, given: dict[str, bool], reason: str) -> None:
        """The other flags are reset."""
        for name in given:
            if name not in (reason, "SFCEnableLimit"):
                given[name] = self.flags[name] = False

    def _name_current(self) -> None:
        if "SFCCurrentStep" in self.outputs:
            for step in self.chart.steps:
                if self.states[step.name].x:
                    self.outputs["SFCCurrentStep"] = step.name

    def _steps(self) -> None:
        for state in self.states.values():
            state.entered, state.left = state.will_enter, state.will_leave
            state.will_enter = state.will_leave = False
            state.x = state.next_x
            if state.entered:
                state.since = self.now
            if state.x:
                state.age = self.now - state.since
        self._name_current()
        for role, member in (("EXIT", "left"), ("ENTRY", "entered")):
            for step in self.chart.steps:
                if role in step.roles and getattr(self.states[step.name], member):
                    self._execute(step.roles[role])
        for step in self.chart.steps:
            self._check_time(step)
            if "STEP" in step.roles and self.states[step.name].x:
                self._execute(step.roles["STEP"])

    def _check_time(self, step: Step) -> None:
        if "SFCError" not in self.outputs or step.maximum < 0 or self.outputs["SFCError"]:
            return
        if not self.flags.get("SFCEnableLimit", True):
            return
        state = self.states[step.name]
        if state.x and state.age > step.maximum:
            self.outputs["SFCError"] = True
            if "SFCErrorStep" in self.outputs:
                self.outputs["SFCErrorStep"] = step.name

    def _execute(self, action: str) -> None:
        self.log = (self.log * 31 + self.chart.actions[action]) % 2**32
        self.n = (self.n + 1 + 2**15) % 2**16 - 2**15

    def _actions(self) -> None:
        last, run = [], []
        for name in self.names:
            on: set[str] = set()
            times: dict[str, int] = {}
            once = False
            for step in self.chart.steps:
                state = self.states[step.name]
                for a in step.associations:
                    if a.action == name:
                        once |= a.qualifier == "P1" and state.entered
                        once |= a.qualifier == "P0" and state.left
                        if state.x and a.qualifier not in ("P0", "P1"):
                            on.add(a.qualifier)
                            times[a.qualifier] = a.time
                        elif a.time >= 0:
                            times.setdefault(a.qualifier, a.time)
            control = self.controls[name]
            active = control(on, times, self.now)
            if control.active and not active:
                last.append(name)
            if active or once:
                run.append(name)
            control.executed = active or once or control.active
            control.active = active
        for name in last:
            if name in self.chart.actions:
                self._execute(name)
        for name in self.names:
            if name in self.chart.actions:
                if name in run:
                    self._execute(name)
            else:
                self.flags[name] = name in run

    def _transitions(self) -> None:
        times = {s.name: s.minimum for s in self.chart.steps}
        for t in sorted(self.chart.transitions, key=lambda t: t.priority or 1 << 31):
            sources = [self.states[name] for name in t.sources]
            if not all(s.x and not s.will_leave for s in sources):
                continue
            if any(self.states[name].age < times[name] for name in t.sources):
                continue
            holds = self.holds(t.condition)
            if not (self.tip if self.flags.get("SFCTipMode") else holds):
                continue
            for s in sources:
                s.next_x, s.will_leave = s.will_enter, True
            for name in t.targets:
                self.states[name].next_x = self.states[name].will_enter = True
            if "SFCTrans" in self.outputs:
                self.outputs["SFCTrans"] = True

    def holds(self, c: Condition) -> bool:
        """Value of a condition; both sides of AND and OR are evaluated."""
        if c.op == "bit":
            return bool(self.r >> c.number & 1)
        if c.op == "flag":
            return bool(self.values()[c.name])
        if c.op == "age":
            return self.states[c.name].age >= c.number
        if c.op == "rest":
            return (abs(self.n) % c.number == 1) and self.n > 0
        found = [self.holds(x) for x in c.operands]
        if c.op == "Ask":
            self.asked[c.number] += 1
            return found[0]
        if c.op == "NOT":
            return not found[0]
        return all(found) if c.op == "AND" else any(found)

    def values(self) -> dict[str, bool | int | str]:
        """Everything that is compared, by path."""
        found: dict[str, bool | int | str] = {"log": self.log, "n": self.n, **self.outputs}
        found |= {name: self.flags[name] for name in self.chart.flags}
        found |= {f"asked[{i}]": count for i, count in enumerate(self.asked)}
        for name, state in self.states.items():
            found[f"{name}.x"], found[f"{name}._x"] = state.x, state.next_x
        for name, control in self.controls.items():
            found[f"_{name}._x"], found[f"_{name}.x"] = control.active, control.executed
        return found
