"""What the server answers, in the language that the client asks for: at the edge, never what is kept.

Shapes name the fields that hold sentences in a class attribute `SENTENCES`; a shape that knows more about
its texts than their words has `in_language(language)` of its own.
"""

from __future__ import annotations

from dataclasses import fields, is_dataclass, replace
from typing import Annotated, Any, TypeVar

import msgspec
from fastapi import Depends
from pydantic import BaseModel
from starlette.requests import HTTPConnection

from tappet.translation.language import Language, accepted
from tappet.translation.sentences import sentence

T = TypeVar("T")


def language_of_request(connection: HTTPConnection) -> Language:
    """What the client wants to read, by its `Accept-Language`."""
    return accepted(connection.headers.get("accept-language"))


async def _wanted(connection: HTTPConnection) -> Language:
    return language_of_request(connection)


LanguageDep = Annotated[Language, Depends(_wanted)]


def in_language(answer: T, language: Language) -> T:
    """An answer with its sentences in a language; what has none is the same object."""
    return answer if language == "en" else _in_language(answer, language)


def _in_language(value: Any, language: Language) -> Any:
    own = getattr(value, "in_language", None)
    if own is not None:
        return own(language)
    if isinstance(value, list | tuple):
        return type(value)(_in_language(item, language) for item in value)
    changed = {}
    for name in _names(value):
        part = getattr(value, name)
        said = (
            _said(part, language) if name in getattr(value, "SENTENCES", ()) else _in_language(part, language)
        )
        if said is not part:
            changed[name] = said
    return _with(value, changed) if changed else value


def _said(part: Any, language: Language) -> Any:
    if isinstance(part, str):
        return sentence(part, language)
    return [sentence(one, language) for one in part] if isinstance(part, list) else part


def _names(value: Any) -> tuple[str, ...]:
    """Fields that may hold sentences, or shapes that do."""
    if isinstance(value, BaseModel):
        return tuple(type(value).model_fields)
    if isinstance(value, msgspec.Struct):
        return value.__struct_fields__
    if is_dataclass(value):
        return tuple(field.name for field in fields(value))
    return ()


def _with(value: Any, changed: dict[str, Any]) -> Any:
    if isinstance(value, BaseModel):
        return value.model_copy(update=changed)
    if isinstance(value, msgspec.Struct):
        return msgspec.structs.replace(value, **changed)
    return replace(value, **changed)
