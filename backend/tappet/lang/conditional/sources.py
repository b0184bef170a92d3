"""All texts of an application to trees, with conditional compilation."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.conditional.directives import has_directives
from tappet.lang.lexer import lex
from tappet.lang.parser import ParseResult, parse, parse_tokens
from tappet.lang.source import Source

if TYPE_CHECKING:
    from tappet.lang.conditional.facts import Facts
    from tappet.lang.conditional.select import Include


@dataclass(frozen=True, slots=True)
class ParseOptions:
    """Settings that conditions depend on."""

    defines: Mapping[str, str] = field(default_factory=dict)
    """Compiler defines of the application (LPRG-06): identifier to value, '' without one."""
    tasks: Sequence[str] = ()
    """Names of the tasks, for `defined (task: name)`."""
    include: Include | None = None
    """Reads an included file and stays inside the project; without it every `{include}` is an error."""


def parse_sources(
    sources: Iterable[Source],
    options: ParseOptions | None = None,
    *,
    plain: Mapping[Source, ParseResult] | None = None,
    others: Sequence[ast.Unit] = (),
) -> list[ParseResult]:
    """Parse every source; `{IF}` branches are decided by what all sources declare together.

    `plain` holds results of `parse` at hand already; they serve for texts without conditional pragmas.
    `others` are trees of the same program that are not parsed here.
    """
    options = options or ParseOptions()
    given = list(sources)
    known = plain or {}
    conditional = [index for index, source in enumerate(given) if has_directives(source.text)]
    chosen = set(conditional)
    results: list[ParseResult | None] = [
        None if index in chosen else known.get(source) or parse(source) for index, source in enumerate(given)
    ]
    if conditional:
        from tappet.lang.conditional.facts import facts_of

        # Conditions may ask about what other conditional texts declare: the first round settles that.
        units = [*(result.unit for result in results if result is not None), *others]
        facts = facts_of(units, options.tasks)
        first = [_parse(given[index], facts, options) for index in conditional]
        facts = facts_of(units + [result.unit for result in first], options.tasks)
        for index in conditional:
            results[index] = _parse(given[index], facts, options)
    return [result for result in results if result is not None]


def _parse(source: Source, facts: Facts, options: ParseOptions) -> ParseResult:
    from tappet.lang.conditional.select import Selection

    selection = Selection(source, facts, dict(options.defines), options.include)
    lexed = selection.run(lex(source.text, source.uri))
    return parse_tokens(source, lexed, tuple(selection.inactive))
