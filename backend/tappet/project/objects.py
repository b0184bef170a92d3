"""Objects whose data fit their kind: making, changing and describing them.

The data of an object whose kind is not installed are kept as they are (CON-03); once it is, they are
validated.
"""

from __future__ import annotations

from typing import Any

from pydantic import BaseModel, ValidationError

from tappet.project.data import SPLIT_TEXTS, Data, UnknownData
from tappet.project.errors import InvalidDataError
from tappet.project.kind_registry import kinds
from tappet.project.model import ProjectObject


def make_object(**fields: Any) -> ProjectObject:
    """The object with these fields; `data` may be a dict. Raises InvalidDataError naming each wrong field."""
    kind = fields.get("kind", "?")
    try:
        fields["data"] = valid_data(kind, fields.get("data", {}))
        return ProjectObject(**fields)
    except ValidationError as error:
        raise InvalidDataError(f"{kind} '{fields.get('name', '?')}': {describe(error)}") from error


def changed_object(item: ProjectObject, **fields: Any) -> ProjectObject:
    """The object with other fields; `data` may be a dict of the kind's data. Raises InvalidDataError."""
    kept = {name: getattr(item, name) for name in ProjectObject.model_fields}
    if "data" in fields or "kind" in fields:
        return make_object(**(kept | fields))
    try:
        return ProjectObject(**(kept | fields))
    except ValidationError as error:
        raise InvalidDataError(f"{item.kind} '{item.name}': {describe(error)}") from error


def stored_object(**fields: Any) -> ProjectObject:
    """The object as it was stored: data that do not fit its kind are kept like those of an unknown one, so
    that a project opens after a plug-in came or changed its model; what uses them says what is wrong."""
    try:
        return make_object(**fields)
    except InvalidDataError:
        kept = UnknownData.model_validate(fields.get("data", {}))
        return ProjectObject(**{**fields, "data": kept})


def valid_data(kind: object, data: object) -> Data:
    """The data of a kind. Raises ValidationError."""
    known = kinds().get(kind) if isinstance(kind, str) else None
    model = known.data if known is not None else UnknownData
    if isinstance(data, model):
        return data
    plain = data.model_dump() if isinstance(data, BaseModel) else data
    if known is not None and isinstance(plain, dict) and SPLIT_TEXTS in plain:
        plain = {key: value for key, value in plain.items() if key != SPLIT_TEXTS}
    return model.model_validate(plain)


def describe(error: ValidationError) -> str:
    """The first problems of a validation as one line: `watchdog.time: 'abc' is no time ...`."""
    lines = []
    for problem in error.errors(include_url=False, include_input=False)[:5]:
        place = ".".join(str(part) for part in problem["loc"]) or "data"
        message = problem["msg"].removeprefix("Value error, ")
        lines.append(f"{place}: {message}")
    return "; ".join(lines)
