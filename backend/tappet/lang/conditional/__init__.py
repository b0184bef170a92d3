"""Conditional compilation: `{IF}` to `{END_IF}`, `{define}`, `{undefine}`, `{include}` (spec LPRG-50..73).

`sources.parse_sources` parses the texts of an application with all conditions decided. That happens on
tokens, before the parser, so that an inactive branch may hold anything. `condition` evaluates, `facts`
answers.
"""

from tappet.lang.conditional.sources import ParseOptions, parse_sources

__all__ = ["ParseOptions", "parse_sources"]
