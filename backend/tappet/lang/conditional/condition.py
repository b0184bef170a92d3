"""The conditions of `{IF}` and `{ELSIF}` (spec LPRG-60..LPRG-73)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from tappet.lang.conditional.facts import Facts
from tappet.lang.lexer import END, ID, STRING, Lexed, lex

_MAX_NESTING = 50
_OPERATORS = {"DEFINED", "HASATTRIBUTE", "HASTYPE", "HASVALUE"}


class ConditionError(ValueError):
    """What is wrong with a condition, as the reason of a message."""


@dataclass(frozen=True, slots=True)
class View:
    """What a condition can ask: the definitions at its place, and the facts its object sees."""

    defines: Mapping[str, str]
    """Upper-case identifier to its replacement, '' without one."""
    facts: Facts
    pou: str | None
    """The POU whose variables are seen."""


def evaluate(text: str, view: View) -> bool:
    """Whether the condition holds. Raises ConditionError when it cannot be understood."""
    parser = _Condition(lex(text, ""), view)
    result = parser.disjunction(0)
    if parser.kind is not END:
        raise ConditionError(f"{parser.shown} is not expected")
    return result


class _Condition:
    """Reads and evaluates at once; both sides of AND and OR are always read."""

    def __init__(self, lexed: Lexed, view: View) -> None:
        self.lexed = lexed
        self.view = view
        self.i = 0

    @property
    def kind(self) -> str:
        return self.lexed.kinds[self.i]

    @property
    def text(self) -> str:
        return self.lexed.texts[self.i]

    @property
    def shown(self) -> str:
        return f"'{self.text}'" if self.kind is not END else "the end"

    def take(self, kind: str, what: str) -> str:
        if self.kind != kind:
            raise ConditionError(f"{what} expected before {self.shown}")
        text = self.text
        self.i += 1
        return text

    def disjunction(self, depth: int) -> bool:
        result = self.conjunction(depth)
        while self.kind == "OR":
            self.i += 1
            right = self.conjunction(depth)
            result = result or right
        return result

    def conjunction(self, depth: int) -> bool:
        result = self.negation(depth)
        while self.kind == "AND":
            self.i += 1
            right = self.negation(depth)
            result = result and right
        return result

    def negation(self, depth: int) -> bool:
        if depth > _MAX_NESTING:
            raise ConditionError(f"more than {_MAX_NESTING} levels are nested")
        if self.kind == "NOT":
            self.i += 1
            return not self.negation(depth + 1)
        if self.kind == "(":
            self.i += 1
            result = self.disjunction(depth + 1)
            self.take(")", "')'")
            return result
        if self.kind in ("TRUE", "FALSE"):
            self.i += 1
            return self.lexed.kinds[self.i - 1] == "TRUE"
        if self.kind == "int":
            self.i += 1
            return int(self.lexed.texts[self.i - 1][:100]) != 0
        return self.operator()

    def operator(self) -> bool:
        word = self.text.upper()
        if self.kind is not ID or word not in _OPERATORS:
            raise ConditionError(f"defined, hasattribute, hastype or hasvalue expected before {self.shown}")
        self.i += 1
        self.take("(", "'('")
        if word == "DEFINED":
            result = self.defined()
        elif word == "HASVALUE":
            name = self.take(ID, "an identifier").upper()
            self.take(",", "','")
            value = self.take(STRING, "a string")[1:-1]
            result = self.view.defines.get(name, "\0").strip("'\"") == value
        else:
            kind = self.selector()
            name = self.name()
            self.take(",", "','")
            ask = self.has_type if word == "HASTYPE" else self.has_attribute
            result = ask(kind, name)
        self.take(")", "')'")
        return result

    def selector(self) -> str:
        """`variable:` or `pou:`; the empty text if there is none."""
        if self.lexed.kinds[self.i + 1] != ":" if self.kind is not END else True:
            return ""
        word = self.text.lower()
        self.i += 2
        return word

    def name(self) -> str:
        parts = [self.take(ID, "a name")]
        while self.kind == ".":
            self.i += 1
            parts.append(self.take(ID, "a name"))
        return ".".join(parts)

    def defined(self) -> bool:
        kind = self.selector()
        name = self.name()
        key = name.upper()
        facts = self.view.facts
        if kind == "":
            return key in self.view.defines
        if kind == "variable":
            return facts.variable(name, self.view.pou) is not None
        if kind == "type":
            return key in facts.types
        if kind == "pou":
            return key in facts.pous
        if kind == "task":
            return key in facts.tasks
        if kind == "resource":
            return key in facts.resources
        raise ConditionError(f"variable, type, pou, task or resource expected instead of '{kind}'")

    def has_type(self, kind: str, name: str) -> bool:
        wanted = self.take(self.kind if self.kind in ("ARRAY", "POINTER") else ID, "a type")
        if kind != "variable":
            raise ConditionError("hastype asks about 'variable: name'")
        variable = self.view.facts.variable(name, self.view.pou)
        return variable is not None and self.view.facts.has_type(variable, wanted)

    def has_attribute(self, kind: str, name: str) -> bool:
        wanted = self.take(STRING, "the attribute as a string")[1:-1].lower()
        if kind == "pou":
            return wanted in self.view.facts.pous.get(name.upper(), ())
        if kind == "variable":
            variable = self.view.facts.variable(name, self.view.pou)
            if variable is None:
                return False
            return any(p.attribute is not None and p.attribute.lower() == wanted for p in variable.attributes)
        raise ConditionError("hasattribute asks about 'pou: name' or 'variable: name'")
