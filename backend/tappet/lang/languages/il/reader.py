"""Rows of IL to statements, with recovery at the end of each row (IL-01..IL-17, IL-60..IL-63).

Differences to the table editor that text brings with it: a label before a row begins a network (IL-09), a
comma at the end of a row continues its operands on the next one (IL-11), and a call in parentheses with
named parameters may span rows (IL-14).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar, Final

from tappet.iec.languages.il import LANGUAGE
from tappet.lang import ast
from tappet.lang.diagnostics import report
from tappet.lang.languages.il.network import Level
from tappet.lang.languages.il.operators import (
    FRESH,
    INSTRUCTIONS,
    WITHOUT_OPERAND,
    WRONG_MODIFIERS,
    Instruction,
)
from tappet.lang.languages.il.recognise import is_instruction_list
from tappet.lang.languages.il.rows import BODY_ENDS, PATHS, RowReader, has_index
from tappet.lang.languages.reader import TextReader
from tappet.lang.lexer import ID
from tappet.lang.parser_core import MAX_NESTING
from tappet.lang.source import Span

if TYPE_CHECKING:
    from tappet.lang.parser_statements import StatementParser


_FAULTING: Final = frozenset({"/", "MOD"})
"""Operators that can end in an exception."""


class InstructionList(TextReader):
    """Rows become statements at once: the accumulator is an expression until something must keep it."""

    name: ClassVar[str] = "IL"

    def begins(self, parser: StatementParser, pou: ast.Pou) -> bool:
        """Rows follow rows; its instruction distinguishes the first one from a statement."""
        if any(not isinstance(statement, ast.PragmaStmt) for statement in pou.body):
            return pou.language == self.name
        return is_instruction_list(parser)

    def read(self, parser: StatementParser, pou: ast.Pou) -> None:
        """The rows up to the end of the body."""
        pou.language = self.name
        pou.body += _Reader(parser).body()


READER = InstructionList()


def read_value(parser: StatementParser) -> tuple[list[ast.Stmt], ast.Expr]:
    """The rows of a transition: statements that compute parts of it, and what the accumulator holds then."""
    return _Reader(parser).value()


class _Reader(RowReader):
    def body(self) -> list[ast.Stmt]:
        """The statements of all rows."""
        self.rows()
        self.end_network()
        self.net.flush_label()
        return self.net.out

    def value(self) -> tuple[list[ast.Stmt], ast.Expr]:
        """What the rows compute, and its value; without one there is a message (E0122)."""
        start = self.p.i
        self.rows()
        self.close_levels()
        if not self.has_value("END_TRANSITION", start):
            return self.net.out, ast.ErrorExpr(span=self.p.span_at(start))
        self.net.flush_label()
        return self.net.out, self.net.use(False, self.p.span_at(start))

    def rows(self) -> None:
        """All rows up to the end of the body."""
        p, net = self.p, self.net
        while True:
            start = p.i
            if start in p.trivia:
                for pragma in p.pragmas_before(start):
                    net.settle(True)
                    net.emit(ast.PragmaStmt(span=pragma.span, pragma=pragma))
            if p.kinds[start] in BODY_ENDS:
                break
            self.row(start)

    # -- rows

    def row(self, start: int) -> None:
        """One instruction with its label; goes to the next row whatever it finds."""
        p, net = self.p, self.net
        if p.kinds[start] is ID and p.kinds[start + 1] == ":":
            self.label(start)
            if p.lines[p.i] != p.lines[start]:
                return
            start = p.i
            if p.kinds[start] in BODY_ENDS:
                return
        net.row += 1
        messages = len(p.diagnostics)
        self.instruction(start)
        if p.i == start:
            p.i += 1
        if len(p.diagnostics) > messages or p.failed_at == p.i:
            self.skip_row()
        elif p.kinds[p.i] == ";" and p.lines[p.i] == p.lines[p.i - 1]:
            p.error("E0129")
            self.skip_row()
        elif not self.at_row_end():
            self.fault("E0121", p.span_at(p.i), op=p.texts[start].upper(), found=p.found())
            self.skip_row()

    def label(self, start: int) -> None:
        """A label begins a network: what the accumulator holds does not pass it (IL-61)."""
        p, net = self.p, self.net
        if len(net.levels) > 1:
            self.fault("E0127", p.span_at(start), what=f"Label '{p.texts[start]}'")
            del net.levels[1:]
            net.level.used = True
        self.end_network()
        net.flush_label()
        p.i = start + 2
        net.label = (p.texts[start], p.span_from(start))
        if net.out or net.row:
            net.number += 1
        net.row = 0

    def end_network(self) -> None:
        """Close what is open and give the accumulator up."""
        self.close_levels()
        self.drop()

    def close_levels(self) -> None:
        """Report the parentheses that are open and close them."""
        net = self.net
        while len(net.levels) > 1:
            level = net.level
            assert level.opener is not None
            op = level.pending.name if level.pending is not None else "the function"
            self.p.diagnostics.append(
                report("E0123", self.p.source.uri, level.opener, network=net.number, row=net.row, op=op)
            )
            level.value = ast.ErrorExpr(span=level.opener)
            self.close_level(level.opener)
            net.level.used = True

    def drop(self) -> None:
        """Give the accumulator up, with a warning when nothing has used its value."""
        began = self.net.level.began
        value = self.net.drop()
        if value is not None and not isinstance(value, ast.ErrorExpr):
            self.p.diagnostics.append(
                report("W1118", self.p.source.uri, value.span, network=self.net.number, row=began)
            )

    # -- instructions

    def instruction(self, start: int) -> None:
        """What stands behind the label of a row."""
        p = self.p
        kind = p.kinds[start]
        word = p.texts[start].upper()
        if kind == ")":
            self.close_parenthesis(start)
            return
        found = INSTRUCTIONS.get(word) if p.kinds[start + 1] != "." else None
        if found is None:
            if word in WRONG_MODIFIERS:
                base, modifier = WRONG_MODIFIERS[word]
                self.fault("E0126", p.span_at(start), op=base, modifier=modifier)
                self.lose(start)
            elif kind is ID or kind in ("THIS", "SUPER", "."):
                self.function(start)
            else:
                self.fault("E0128", p.span_at(start), found=p.found())
                self.lose(start)
            return
        p.i = start + 1
        action = found.action
        if action == "load":
            self.load(found, start)
        elif action == "combine":
            self.combine(found, start)
        elif action in ("store", "set", "reset"):
            self.store(found, start)
        elif action == "not":
            if self.has_value(found.name, start):
                self.net.combine(self.complement(self.taken(), p.span_at(start)), p.span_at(start))
        elif action == "call":
            self.call(found, start)
        else:
            self.leave(found, start)

    def has_value(self, name: str, start: int) -> bool:
        """Whether the accumulator holds something; reports at the operator when not (IL-61)."""
        if self.net.level.value is not None:
            return True
        self.fault("E0122", self.p.span_at(start), op=name)
        self.net.level.value = ast.ErrorExpr(span=self.p.span_at(start))
        return False

    def lose(self, start: int) -> None:
        """What the accumulator holds behind a faulty row is not known: rows that use it are no faults."""
        level = self.net.level
        level.value, level.used = ast.ErrorExpr(span=self.p.span_at(start)), True

    def taken(self) -> ast.Expr:
        """The accumulator as a part of the expression that takes its place."""
        value = self.net.level.value
        assert value is not None
        if isinstance(value, ast.Held):
            return ast.Held(span=value.span, slot=value.slot)
        return value

    def complement(self, operand: ast.Expr, at: Span) -> ast.Expr:
        """NOT of an operand; the span takes the operator in."""
        span = at.to(operand.span) if at[:2] < operand.span[:2] else operand.span.to(at)
        return ast.Unary(span=span, op="NOT", operand=operand)

    def load(self, found: Instruction, start: int) -> None:
        operand = self.operand(found.name)
        self.drop()
        if operand is None:
            self.lose(start)
            return
        if found.negated:
            operand = self.complement(operand, self.p.span_at(start))
        self.net.set(operand, self.p.span_at(start))

    def combine(self, found: Instruction, start: int) -> None:
        p = self.p
        fine = self.has_value(found.name, start)
        negated = found.negated
        if found.operator in ("AND", "OR", "XOR") and self.at_separate_modifier():
            p.i += 2
            negated = True
        if p.kinds[p.i] == "(" and not self.at_row_end():
            pending = found if negated == found.negated else INSTRUCTIONS[found.name + "N"]
            operands = self.deferred(pending, None, start)
        else:
            operands = self.operands(found.name)
        for operand in operands:
            if fine:
                if found.operator in _FAULTING or has_index(operand):
                    self.net.settle(True)  # so that an exception names this row
                joined = self.joined(found.operator, self.taken(), operand, negated)
                self.net.combine(joined, p.span_at(start))

    def joined(self, operator: str, left: ast.Expr, right: ast.Expr, negated: bool) -> ast.Expr:
        """`left operator right`."""
        if negated:
            right = ast.Unary(span=right.span, op="NOT", operand=right)
        return ast.Binary(span=left.span.to(right.span), op=operator, left=left, right=right)

    def store(self, found: Instruction, start: int) -> None:
        """ST, STN, S and R, to one operand or to several in turn."""
        p, net = self.p, self.net
        fine = self.has_value(found.name, start)
        targets = self.operands(found.name)
        if not targets:
            self.net.level.used = True  # the row says enough
        if not fine:
            return
        for number, target in enumerate(targets):
            again = number + 1 < len(targets) or not self.at_fresh_row()
            begin = p.span_at(start)
            held = isinstance(net.level.value, ast.Held)
            first = net.level.start
            value = net.use(again, begin)
            if found.negated:
                value = ast.Unary(span=value.span, op="NOT", operand=value)
            span = p.span_from(start)
            if not again and not held and first is not None:
                span = first.to(span)
            op = {"set": "S=", "reset": "R="}.get(found.action, ":=")
            net.emit(ast.Assign(span=span, op=op, target=target, value=value))

    def at_fresh_row(self) -> bool:
        """Whether the next row has no use for the accumulator."""
        p = self.p
        if p.kinds[p.i] in BODY_ENDS:
            return True
        if p.kinds[p.i + 1] == ":":
            return p.kinds[p.i] is ID
        return p.texts[p.i].upper() in FRESH and len(self.net.levels) == 1

    def leave(self, found: Instruction, start: int) -> None:
        """JMP and RET with their conditional forms."""
        p, net = self.p, self.net
        statement: ast.Stmt
        if found.action == "jump":
            if p.kinds[p.i] is not ID or self.at_row_end():
                self.fault("E0120", p.span_at(start), op=found.name, what="a label")
                return
            target = p.texts[p.i]
            p.i += 1
            place = p.span_at(p.i - 1)
            statement = ast.Jump(span=p.span_from(start), target=target, target_span=place)
        else:
            statement = ast.Return(span=p.span_at(start))
        if len(net.levels) > 1:
            self.fault("E0127", p.span_at(start), what=found.name)
            return
        if found.conditional:
            self.when(found, start, statement)
            return
        if net.level.value is not None and not net.level.used:
            self.fault("W1149", p.span_at(start), op=found.name)
            net.level.used = True
        self.drop()
        net.emit(statement)

    def when(self, found: Instruction, start: int, statement: ast.Stmt) -> None:
        """`statement` under the condition of the accumulator (IL-20, IL-21)."""
        if not self.has_value(found.name, start):
            return
        span = self.p.span_at(start)
        condition = self.net.use(not self.at_fresh_row(), span)
        if found.negated:
            condition = ast.Unary(span=condition.span, op="NOT", operand=condition)
        self.net.emit(ast.If(span=statement.span, branches=[(condition, [statement])]))

    def call(self, found: Instruction, start: int) -> None:
        """CAL with its parameter list (IL-14, IL-15)."""
        p, net = self.p, self.net
        if self.at_row_end():
            self.fault("E0120", p.span_at(start), op=found.name, what="an instance, a program or an action")
            return
        callee = p.operand()
        if isinstance(callee, PATHS):
            callee = ast.Call(span=callee.span, callee=callee, args=[])
        if not isinstance(callee, ast.Call):
            if not isinstance(callee, ast.ErrorExpr):
                self.fault("E0120", callee.span, op=found.name, what="an instance, a program or an action")
            return
        self.check_arguments(callee)
        statement = ast.CallStmt(span=p.span_from(start), call=callee)
        if found.conditional:
            self.when(found, start, statement)
            return
        net.settle(True)
        net.emit(statement)

    # -- functions

    def function(self, start: int) -> None:
        """A function or method: the accumulator is its first operand (IL-13, IL-16)."""
        p, net = self.p, self.net
        callee = self.path()
        name = p.texts[start]
        same_row = not self.at_row_end()
        if p.kinds[p.i] == "(" and same_row and self.is_formal():
            call = ast.Call(callee=callee, args=p.arguments())
            call.span = p.span_from(start)
            self.check_arguments(call)
            self.drop()
            net.set(call, p.span_at(start))
            return
        accumulator = None
        if net.level.value is not None and name.upper() not in WITHOUT_OPERAND:
            if name.upper().endswith(LANGUAGE.call_modifier):
                net.settle(True)  # the condition, and what stays when nothing is called (IL-52)
            accumulator = self.taken()
        if p.kinds[p.i] == "(" and same_row:
            operands = self.deferred(None, callee, start)
            if net.level.function is callee:
                return
        else:
            operands = [] if self.at_row_end() else self.operands(name)
        if accumulator is None:
            self.drop()
        value = self.called(callee, accumulator, operands, p.span_from(start))
        if accumulator is None:
            net.set(value, p.span_at(start))
        else:
            net.combine(value, p.span_at(start))

    # -- parentheses

    def deferred(self, pending: Instruction | None, function: ast.Expr | None, start: int) -> list[ast.Expr]:
        """`(`: the operands if `)` stands in the same row, else a new level that `)` closes.

        Source: IL-12, IL-23.
        """
        p, net = self.p, self.net
        p.i += 1
        name = p.texts[start].upper()
        operands: list[ast.Expr] = []
        begin = p.span_at(start)
        if not self.at_row_end():
            begin = p.span_at(p.i)
            operands = self.operands(name)
            if not operands:
                return []
            if p.kinds[p.i] == ")" and not self.at_row_end():
                p.i += 1
                return operands
            if len(operands) > 1 and function is None:
                p.missing(")", "Close the list of operands in its row, or write one operand a row.")
                return operands
        if len(net.levels) >= MAX_NESTING:
            p.error("E0107", what="parenthesis", limit=MAX_NESTING)
            return operands
        level = Level(pending=pending, function=function, opener=p.span_at(start))
        level.before = operands[:-1]
        net.levels.append(level)
        if operands:
            net.set(operands[-1], begin)
        return []

    def close_parenthesis(self, start: int) -> None:
        """`)`: the operation that has been waiting is carried out (IL-51)."""
        p, net = self.p, self.net
        p.i = start + 1
        if len(net.levels) == 1:
            self.fault("E0106", p.span_at(start), found="')'", hint="Remove it or write the '(' it closes.")
            return
        self.close_level(p.span_at(start))

    def close_level(self, at: Span) -> None:
        """Take the innermost level into the one around it."""
        net = self.net
        level = net.levels[-1]
        value = level.value
        if value is None and level.function is None:
            assert level.pending is not None
            self.fault("E0120", at, op=level.pending.name, what="an operand")
            value = ast.ErrorExpr(span=at)
        net.levels.pop()
        accumulator = self.taken() if net.level.value is not None else None
        if level.function is not None:
            operands = [*level.before, value] if value is not None else level.before
            opener = level.opener or at
            call = self.called(level.function, accumulator, operands, opener.to(at))
            if accumulator is None:
                net.set(call, opener)
            else:
                net.combine(call, opener)
            return
        assert level.pending is not None
        assert value is not None
        if accumulator is not None:
            pending = level.pending
            if pending.operator in _FAULTING:
                net.settle(True)
                accumulator = self.taken()
            joined = self.joined(pending.operator, accumulator, value, pending.negated)
            net.combine(joined, level.opener or at)
