"""The languages that bodies are written in, as plain data: one module a language, and plug-ins.

Each module, or entry point of the group `tappet.languages`, gives one `Language`; nothing else lists them.
`reader` names what reads bodies: `lang.languages.reader_of` imports it with the first such body, so that
reading a project imports no compiler. Modules and entry points are looked up once a process.
"""

from __future__ import annotations

import logging
from importlib import import_module
from pkgutil import iter_modules

from tappet.iec.languages.language import Form, Language
from tappet.plug_ins import entry_points

log = logging.getLogger(__name__)
GROUP = "tappet.languages"
"""Entry points of plug-ins: each is a `Language`."""

_found: dict[str, Language] = {}


def languages() -> dict[str, Language]:
    """All languages by name, in the order of lists."""
    if not _found:
        known: dict[str, Language] = {}
        for language in (*_of_folder(), *_of_plugins()):
            if known.setdefault(language.name, language) is not language:
                log.warning("a second language named %s is left out", language.name)
        _found.update(sorted(known.items(), key=lambda item: (item[1].rank, item[0])))
    return _found


def language_of(name: str) -> Language:
    """A language by its name; one that nobody knows here is kept as it is and cannot be compiled."""
    return languages().get(name) or Language(name, name, text=False)


def file_ending(name: str, body: str) -> str | None:
    """Ending of the file that holds a body in a language by itself; None where it is text among text."""
    known = language_of(name)
    if known.form_of(body) == "drawn":
        return known.extension
    return None if name in languages() or not body else name.lower()


def is_plain_text(name: str) -> bool:
    """Whether whatever is stored as a body in a language is text that is compiled."""
    known = language_of(name)
    return bool(known.reader) and known.text and not known.drawn and not known.begins


def offered() -> tuple[str, ...]:
    """Names of the languages that the body of a new object can be in; the first is usual."""
    return tuple(name for name, language in languages().items() if language.offered)


def look_again() -> None:
    """Look for languages again at the next question: a plug-in has come or gone."""
    _found.clear()


def _of_folder() -> list[Language]:
    modules = [module.name for module in iter_modules(__path__) if module.name != "language"]
    return [import_module(f"{__name__}.{name}").LANGUAGE for name in modules]


def _of_plugins() -> list[Language]:
    found = []
    for point in entry_points(GROUP):
        try:
            language = point.load()
        except Exception:
            log.exception("the language of entry point %s cannot be loaded", point.value)
            continue
        if isinstance(language, Language):
            found.append(language)
        else:
            log.error("entry point %s gives no Language", point.value)
    return found


__all__ = [
    "GROUP",
    "Form",
    "Language",
    "file_ending",
    "is_plain_text",
    "language_of",
    "languages",
    "look_again",
    "offered",
]
