"""Reaching assignments and liveness of local variables, computed along the flow of control.

`Reaching` goes forward and knows, at each read, whether some way and whether every way here has assigned the
variable. `Liveness` goes backward and finds the assignments whose value nothing reads. Both follow branches,
loops, RETURN, EXIT and CONTINUE; bodies with labels are left to the caller.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from tappet.lang import ast
from tappet.lang.dataflow.for_loops import iterations
from tappet.lang.symbols import BuiltinSymbol
from tappet.lang.walk import all_expressions, bodies, expressions, own_expressions, statements

_BY_ADDRESS = frozenset({"ADR", "BITADR", "XADR", "SIZEOF", "XSIZEOF", "UPPER_BOUND", "LOWER_BOUND"})


@dataclass(slots=True)
class _Assigned:
    """What has been assigned on some way, and on every way, to a place."""

    some: set[int]
    every: set[int]

    def copy(self) -> _Assigned:
        return _Assigned(set(self.some), set(self.every))


def handed_over(e: ast.Expr) -> Iterable[ast.Expr]:
    """What an expression lets others write: arguments of outputs and in-outs, operands of ADR, targets."""
    if isinstance(e, ast.Call):
        builtin = isinstance(e.target, BuiltinSymbol)
        for arg in e.args:
            if arg.value is None:
                continue
            if builtin:
                name = e.target.name if isinstance(e.target, BuiltinSymbol) else ""
                if name in _BY_ADDRESS or name.startswith("__"):
                    yield arg.value
            elif getattr(arg.parameter, "section", "VAR_IN_OUT") != "VAR_INPUT" or arg.output:
                yield arg.value
    elif isinstance(e, ast.AssignExpr):
        yield e.target


def _names(roots: Iterable[ast.Expr], watched: Iterable[int]) -> set[int]:
    found = {id(e.symbol) for root in roots for e in expressions(root) if isinstance(e, ast.Name)}
    return found.intersection(watched)


class Reaching:
    """Forward analysis: collects the first read of each variable that has no value on any way, or on some."""

    def __init__(self, watched: Iterable[int]) -> None:
        self.watched = set(watched)
        self.never: dict[int, ast.Name] = {}
        """Read where no way has assigned the variable."""
        self.sometimes: dict[int, ast.Name] = {}
        """Read where some way has assigned it and another has not."""
        self.ends: list[_Assigned] = []
        """What has been assigned where the body returns and where it ends."""
        self.exits: list[list[_Assigned]] = []
        """What has been assigned at each EXIT, by loop, the innermost last."""
        self.continues: list[list[_Assigned]] = []
        """What has been assigned at each CONTINUE, by loop, the innermost last."""

    def run(self, body: list[ast.Stmt]) -> None:
        """Follows a whole body."""
        end = self._body(body, _Assigned(set(), set()))
        if end is not None:
            self.ends.append(end)

    def _body(self, body: list[ast.Stmt], state: _Assigned | None) -> _Assigned | None:
        for s in body:
            if state is None:
                return None
            state = self._statement(s, state)
        return state

    def _statement(self, s: ast.Stmt, state: _Assigned) -> _Assigned | None:
        if isinstance(s, ast.Assign):
            self._read(s.value, state)
            if not isinstance(s.target, ast.Name):
                self._read(s.target, state, target=True)
            self._assign([s.target], state)
        elif isinstance(s, ast.If):
            return self._branches(s, state)
        elif isinstance(s, ast.Case):
            self._read(s.selector, state)
            ends = [self._body(branch.body, state.copy()) for branch in s.branches]
            ends.append(self._body(s.otherwise, state.copy()) if s.otherwise is not None else state)
            return _joined(ends)
        elif isinstance(s, (ast.For, ast.While, ast.RepeatUntil)):
            return self._loop(s, state)
        elif isinstance(s, ast.Return):
            self.ends.append(state.copy())
            return None
        elif isinstance(s, ast.Exit):
            if self.exits:
                self.exits[-1].append(state)
            return None
        elif isinstance(s, ast.Continue):
            if self.continues:
                self.continues[-1].append(state)
            return None
        elif isinstance(s, ast.Try):
            return self._try(s, state)
        elif isinstance(s, ast.WhenDeclared):
            return self._body(s.chosen, state)
        else:
            for e in _outermost(s):
                self._read(e, state)
        return state

    def _branches(self, s: ast.If, state: _Assigned) -> _Assigned | None:
        ends: list[_Assigned | None] = []
        for condition, body in s.branches:
            self._read(condition, state)
            ends.append(self._body(body, state.copy()))
        ends.append(self._body(s.otherwise, state) if s.otherwise is not None else state)
        return _joined(ends)

    def _try(self, s: ast.Try, state: _Assigned) -> _Assigned | None:
        """Through the body, or through a part of it and the handler; __FINALLY stands on every way out."""
        left = [self.ends, *self.exits[-1:], *self.continues[-1:]]
        known = [len(ways) for ways in left]
        faulty = state.copy()
        faulty.some |= self._assigned_in(s.body)
        after = self._body(s.body, state.copy())
        if s.caught:
            after = _joined([after, self._body(s.handler, faulty.copy())])
            faulty.some |= self._assigned_in(s.handler)
        for ways, count in zip(left, known, strict=True):
            reached = [self._body(s.final, way) for way in ways[count:]]
            ways[count:] = [way for way in reached if way is not None]
        self._body(s.final, faulty)  # and on, out of here
        return self._body(s.final, after)

    def _loop(self, s: ast.For | ast.While | ast.RepeatUntil, state: _Assigned) -> _Assigned | None:
        if isinstance(s, ast.For):
            for e in (s.start, s.stop, s.step):
                if e is not None:
                    self._read(e, state)
            self._assign([s.variable], state)
        state.some |= self._assigned_in([s])
        if isinstance(s, ast.While):
            self._read(s.condition, state)
        self.exits.append([])
        self.continues.append([])
        end = self._body(s.body, state.copy())
        continues, exits = self.continues.pop(), self.exits.pop()
        if isinstance(s, ast.While) and s.condition.is_constant and s.condition.constant:
            return _joined(exits)
        if not isinstance(s, ast.RepeatUntil):
            return _joined([end, *continues, *exits] if _runs(s) else [state, *exits])
        end = _joined([end, *continues])
        if end is not None:
            self._read(s.condition, end)
        return _joined([end, *exits])

    def _assigned_in(self, body: list[ast.Stmt]) -> set[int]:
        """Variables that some statement of a list assigns or hands over."""
        found: set[int] = set()
        for s in statements(body):
            if isinstance(s, ast.Assign):
                found |= _names([s.target], self.watched)
            elif isinstance(s, ast.For):
                found |= _names([s.variable], self.watched)
            for e in own_expressions(s):
                found |= _names(handed_over(e), self.watched)
        return found

    def _read(self, root: ast.Expr, state: _Assigned, target: bool = False) -> None:
        for e in expressions(root):
            given = list(handed_over(e))
            if given:
                self._assign(given, state)
            elif isinstance(e, ast.Name) and not target:
                key = id(e.symbol)
                if key not in self.watched or key in state.every:
                    continue
                (self.sometimes if key in state.some else self.never).setdefault(key, e)

    def _assign(self, targets: Iterable[ast.Expr], state: _Assigned) -> None:
        found = _names(targets, self.watched)
        state.some |= found
        state.every |= found


def _runs(s: ast.For | ast.While) -> bool:
    """Whether a loop has a first iteration for certain."""
    if isinstance(s, ast.While):
        return False
    found = iterations(s)
    return found is not None and found.any


def _joined(states: Iterable[_Assigned | None]) -> _Assigned | None:
    reached = [state for state in states if state is not None]
    if not reached:
        return None
    return _Assigned(
        set().union(*(state.some for state in reached)),
        set.intersection(*(state.every for state in reached)),
    )


def _outermost(s: ast.Stmt) -> list[ast.Expr]:
    """The expressions of a simple statement, each with all below it once."""
    if isinstance(s, ast.CallStmt):
        return [s.call]
    if isinstance(s, ast.ExprStmt):
        return [s.expr]
    return [s.value] if isinstance(s, ast.Hold) else []


class Liveness:
    """Backward analysis: `dead` holds the targets of assignments whose value nothing reads."""

    def __init__(self, watched: Iterable[int], body: list[ast.Stmt]) -> None:
        self.dead: list[ast.Name] = []
        self.read: set[int] = set()
        """What is read at all."""
        everything = set(watched)
        handed: set[int] = set()
        for s in statements(body):
            if isinstance(s, ast.For):
                handed |= _names([s.variable], everything)
            elif isinstance(s, ast.Try):
                handed |= _names(all_expressions([s]), everything)
        for e in all_expressions(body):
            handed |= _names(handed_over(e), everything)
        self.watched = everything - handed
        self.after_loop: list[set[int]] = []
        self.next_iteration: list[set[int]] = []
        self._body(body, set())

    def _body(self, body: list[ast.Stmt], live: set[int]) -> set[int]:
        for s in reversed(body):
            live = self._statement(s, live)
        return live

    def _reads(self, *roots: ast.Expr | None) -> set[int]:
        found = _names([root for root in roots if root is not None], self.watched)
        self.read |= found
        return found

    def _statement(self, s: ast.Stmt, live: set[int]) -> set[int]:
        if isinstance(s, ast.Assign):
            if isinstance(s.target, ast.Name) and s.op == ":=":
                key = id(s.target.symbol)
                if key in self.watched and key not in live:
                    self.dead.append(s.target)
                return (live - {key}) | self._reads(s.value)
            return live | self._reads(s.value, s.target)
        if isinstance(s, ast.If):
            found = self._body(s.otherwise, set(live)) if s.otherwise is not None else set(live)
            for condition, body in s.branches:
                found |= self._body(body, set(live)) | self._reads(condition)
            return found
        if isinstance(s, ast.Case):
            found = self._body(s.otherwise, set(live)) if s.otherwise is not None else set(live)
            for branch in s.branches:
                found |= self._body(branch.body, set(live))
            return found | self._reads(s.selector)
        if isinstance(s, (ast.For, ast.While, ast.RepeatUntil)):
            return self._loop(s, live)
        if isinstance(s, ast.Return):
            return set()
        if isinstance(s, ast.Exit):
            return set(self.after_loop[-1]) if self.after_loop else live
        if isinstance(s, ast.Continue):
            return set(self.next_iteration[-1]) if self.next_iteration else live
        if isinstance(s, ast.WhenDeclared):
            return self._body(s.chosen, live)
        for part in bodies(s):
            live |= self._body(part, set(live))
        return live | self._reads(*own_expressions(s))

    def _loop(self, s: ast.For | ast.While | ast.RepeatUntil, live: set[int]) -> set[int]:
        """A value that some iteration reads is live at the end of each iteration."""
        head = live | self._reads(*all_reads(s))
        self.after_loop.append(live)
        self.next_iteration.append(head)
        begin = self._body(s.body, set(head))
        self.after_loop.pop()
        self.next_iteration.pop()
        if isinstance(s, ast.RepeatUntil):
            return begin
        own = self._reads(s.condition) if isinstance(s, ast.While) else self._reads(s.start, s.stop, s.step)
        return begin | live | own


def all_reads(s: ast.Stmt) -> Iterable[ast.Expr]:
    """What a statement and those inside it read: all but the plain targets of assignments."""
    for inner in statements([s]):
        if isinstance(inner, ast.Assign) and isinstance(inner.target, ast.Name) and inner.op == ":=":
            yield inner.value
        else:
            yield from own_expressions(inner)
