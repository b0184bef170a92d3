"""Random charts: sequences, alternative and simultaneous branches, loops; a line has one token at most."""

from __future__ import annotations

from random import Random

from chart_tree import Association, Chart, Condition, Step, Transition

_UNTIMED = ("N", "N", "N", "S", "R", "P")
_TIMED = ("L", "D", "SD", "DS", "SL")
_TIMES = (0, 5, 10, 15, 20, 35, 50)


class ChartMaker:
    """One random chart."""

    def __init__(self, r: Random) -> None:
        self.r = r
        self.chart = Chart()
        names = r.sample(["Ab", "aC", "B", "b2", "Da", "D_1", "zz", "Y"], r.randint(2, 6))
        self.chart.actions = {name: number for number, name in enumerate(names, 1)}
        self.chart.flags = [f"w{i}" for i in range(r.randint(1, 3))]
        once = names[0] if self.chance(40) else ""
        self.once = once
        """An action that is controlled by P0 and P1 only."""
        controlled = [*(n for n in names if n != once), *self.chart.flags]
        self.times = {(n, q): r.choice(_TIMES) for n in controlled for q in _TIMED}
        self.controlled = controlled

    def chance(self, percent: int) -> bool:
        return self.r.randrange(100) < percent

    def step(self) -> str:
        r = self.r
        made = Step(f"S{len(self.chart.steps)}")
        for _ in range(r.choice((0, 1, 1, 2, 3))):
            action = r.choice(self.controlled)
            qualifier = r.choice(_UNTIMED if self.chance(50) else _TIMED)
            association = Association(action, qualifier, self.times.get((action, qualifier), -1))
            if association not in made.associations:
                made.associations.append(association)
        if self.once and self.chance(30):
            made.associations.append(Association(self.once, r.choice(("P0", "P1"))))
        for role in ("STEP", "ENTRY", "EXIT"):
            if self.chance(20):
                made.roles[role] = r.choice(list(self.chart.actions))
        if self.chance(15):
            made.minimum = r.choice(_TIMES)
        if self.chance(30):
            made.maximum = r.choice(_TIMES)
        self.chart.steps.append(made)
        return made.name

    def condition(self, steps: tuple[str, ...], depth: int = 2) -> Condition:
        r = self.r
        choice = r.randrange(100)
        if depth and choice < 40:
            op = r.choice(("NOT", "AND", "OR", "Ask"))
            inner = [self.condition(steps, depth - 1) for _ in range(1 if op in ("NOT", "Ask") else 2)]
            return Condition(op, tuple(inner), number=r.randrange(8))
        if choice < 65:
            return Condition("bit", number=r.randrange(8))
        if choice < 80:
            return Condition("age", name=r.choice(steps), number=r.choice(_TIMES))
        if choice < 88:
            return Condition("rest", number=r.choice((2, 3, 5)))
        if choice < 94:
            return Condition("flag", name=r.choice(self.chart.flags))
        return Condition("flag", name=f"{r.choice(self.chart.steps).name}.x")

    def join(self, sources: list[str], targets: list[str], priority: int = 0) -> None:
        condition = self.condition(tuple(sources))
        self.chart.transitions.append(Transition(tuple(sources), tuple(targets), condition, priority))

    def line(self, first: str, depth: int) -> str:
        """What follows a step, up to the last step of the line, which no transition leaves yet."""
        current, own = first, [first]
        for _ in range(self.r.choice((1, 2, 3, 4) if depth == 2 else (0, 0, 1, 2))):
            choice = self.r.randrange(100)
            if self.chance(15):
                self.join([current], [self.r.choice(own)])
            if depth and choice < 30:
                current = self.alternative(current, own, depth)
            elif depth and choice < 55:
                begins = [self.step() for _ in range(self.r.choice((2, 2, 3)))]
                self.join([current], begins)
                ends = [self.line(begin, depth - 1) for begin in begins]
                current = self.step()
                self.join(ends, [current])
            else:
                following = self.step()
                self.join([current], [following])
                current = following
            own.append(current)
        return current

    def alternative(self, current: str, own: list[str], depth: int) -> str:
        count = self.r.choice((2, 2, 3))
        order = self.r.sample(range(1, 10), count) if self.chance(40) else [0] * count
        ends = []
        for priority in order:
            begin = self.step()
            self.join([current], [begin], priority)
            ends.append(self.line(begin, depth - 1))
        after = self.step()
        for number, end in enumerate(ends):
            back = number and self.chance(20)
            self.join([end], [self.r.choice(own) if back else after])
        return after

    def make(self) -> Chart:
        first = self.step()
        last = self.line(first, 2)
        main = [first, last]
        self.join([last], [self.r.choice(main)])
        for flag in ("SFCInit", "SFCReset", "SFCPause"):
            if self.chance(25):
                self.chart.inputs[flag] = (self.r.randrange(8, 16), self.r.randrange(16, 24))
        if self.chance(20):
            for flag in ("SFCTipMode", "SFCTip"):
                self.chart.inputs[flag] = self.r.choice(((0, 0), (8, 8), (9, 10)))
        for flag in ("SFCTrans", "SFCCurrentStep"):
            if self.chance(40):
                self.chart.outputs.append(flag)
        if self.chance(40):
            self.chart.outputs += ["SFCError", *(["SFCErrorStep"] if self.chance(70) else [])]
            if self.chance(30):
                self.chart.inputs["SFCEnableLimit"] = (16, 16)
            if self.chance(50):
                self.chart.inputs["SFCQuitError"] = (self.r.randrange(8, 16), self.r.randrange(16, 24))
        return self.chart
