"""The readers of bodies: one package or module a language, found through `iec.languages`.

`reader` says what a reader is, `drawn` is the base of those whose bodies are elements; `lang.lowering` turns
what they read into statements. May import the parser parts of `lang` up to the statements. Begin with
`reader`.
"""

from __future__ import annotations

from collections.abc import Iterator
from importlib import import_module

from tappet.iec.languages import language_of, languages
from tappet.lang.languages.reader import BodyReader, TextReader

_loaded: dict[str, BodyReader] = {}


def reader_of(language: str) -> BodyReader:
    """The reader of a language by name. Raises LookupError for a language that is only kept."""
    known = language_of(language)
    if not known.reader:
        raise LookupError(f"nothing reads bodies in {language}")
    found = _loaded.get(known.reader)
    if found is None:
        module, _, name = known.reader.partition(":")
        found = _loaded[known.reader] = getattr(import_module(module), name)
    return found


def text_readers() -> Iterator[TextReader]:
    """The readers of text in the order they are asked: ST, which takes any text, is the last one."""
    for language in reversed(languages().values()):
        if language.text and language.reader:
            reader = reader_of(language.name)
            assert isinstance(reader, TextReader)
            yield reader
