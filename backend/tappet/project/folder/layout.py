"""The files that are not text of an object: the project file, the index of a folder, JSON data."""

from __future__ import annotations

import json
import uuid
from typing import Annotated, Any

from pydantic import BaseModel, ConfigDict, Field, StrictInt, TypeAdapter, ValidationError

from tappet.project.errors import FolderFormatError
from tappet.project.objects import describe
from tappet.project.project_file import PROJECT_FILE

FORMAT = 1
"""Version of the folder format that is written; this and older ones are read."""

DEVICES = "Devices"
POUS = "POUs"
"""Folders of the two views."""

_ID_SPACE = uuid.UUID("6f0d5f4e-55b0-4e0c-9c58-1f7a3d0b6a11")


class ProjectFile(BaseModel):
    """`tappet-project.json`."""

    model_config = ConfigDict(extra="forbid")

    format: StrictInt = Field(ge=1)
    name: str = Field(min_length=1, max_length=200)
    description: str = ""


Endings = dict[str, Annotated[str, Field(pattern=r"^[a-z0-9]{1,16}$")]]


class Entry(BaseModel):
    """One child in an index, in the order of the tree."""

    model_config = ConfigDict(extra="forbid")

    kind: str
    name: str
    id: str | None = Field(default=None, pattern=r"^[0-9a-f]{32}$")
    split: Annotated[int, Field(strict=True, ge=0)] | None = None
    options: dict[str, Any] | None = None
    texts: Endings | None = None
    """Data fields that are text files of their own, `<name>.<ending>`, by field: the ending."""


_INDEX: TypeAdapter[list[Entry]] = TypeAdapter(list[Entry])
_ENDINGS: TypeAdapter[Endings] = TypeAdapter(Endings)


def derived_id(path: str) -> str:
    """The id of an object whose index gives none: the same for the same path of files, on every load."""
    return uuid.uuid5(_ID_SPACE, path).hex


def write_project_file(name: str, description: str) -> bytes:
    """The project file."""
    return write_json({"description": description, "format": FORMAT, "name": name})


def read_project_file(content: bytes) -> ProjectFile:
    """The project file. Raises FolderFormatError, also for a format that is newer than this program."""
    raw = read_json(PROJECT_FILE, content)
    version = raw.get("format") if isinstance(raw, dict) else None
    if isinstance(version, int) and version > FORMAT:
        raise FolderFormatError(
            PROJECT_FILE,
            f"the project has format {version}, made by a newer version of Tappet; "
            f"this one reads formats up to {FORMAT}",
        )
    try:
        return ProjectFile.model_validate(raw)
    except ValidationError as error:
        raise FolderFormatError(PROJECT_FILE, describe(error)) from error


def write_index(entries: list[Entry]) -> bytes:
    """An index: a JSON list with one child on each line, so that a diff shows the child."""
    lines = [
        json.dumps(entry.model_dump(exclude_none=True), sort_keys=True, ensure_ascii=False)
        for entry in entries
    ]
    return ("[\n  " + ",\n  ".join(lines) + "\n]\n").encode()


def read_index(path: str, content: bytes) -> list[Entry]:
    """An index. Raises FolderFormatError."""
    try:
        return _INDEX.validate_python(read_json(path, content))
    except ValidationError as error:
        raise FolderFormatError(path, describe(error)) from error


def read_endings(value: object) -> Endings:
    """Endings of text files by data field; nothing where the value is none, or files would have the same
    name."""
    try:
        found = _ENDINGS.validate_python(value)
    except ValidationError:
        return {}
    return found if len(set(found.values())) == len(found) and "json" not in found.values() else {}


def write_json(data: Any, *, flat: bool = False) -> bytes:
    """JSON with sorted keys, two blanks of indentation and a final line break.

    With `flat`, objects below the first one that hold no lists and no objects stand in one line.
    """
    return ((_rows(data, "\n") if flat else _json(data, indent=2)) + "\n").encode()


def _json(value: Any, indent: int | None = None) -> str:
    return json.dumps(value, sort_keys=True, ensure_ascii=False, indent=indent, allow_nan=False)


def _rows(value: Any, line: str, *, outermost: bool = True) -> str:
    """JSON whose flat objects are lines; `line` begins a line of the value itself."""
    inner = line + "  "
    if isinstance(value, dict) and (
        outermost or any(isinstance(member, dict | list) for member in value.values())
    ):
        members = [f"{_json(key)}: {_rows(value[key], inner, outermost=False)}" for key in sorted(value)]
        return "{" + inner + f",{inner}".join(members) + line + "}" if members else "{}"
    if isinstance(value, list) and value:
        items = [_rows(item, inner, outermost=False) for item in value]
        return "[" + inner + f",{inner}".join(items) + line + "]"
    return _json(value)


def read_json(path: str, content: bytes) -> Any:
    """A JSON file. Raises FolderFormatError naming the line; doubled keys and NaN are errors too."""
    text = read_utf8(path, content)
    try:
        return json.loads(text, object_pairs_hook=_unique_keys, parse_constant=_no_constant)
    except json.JSONDecodeError as error:
        raise FolderFormatError(path, f"line {error.lineno}: {error.msg}") from error
    except (ValueError, RecursionError) as error:
        raise FolderFormatError(path, str(error)) from error


def read_utf8(path: str, content: bytes) -> str:
    """A text file in UTF-8, with line feeds and without a byte order mark. Raises FolderFormatError."""
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = content.count(b"\n", 0, error.start) + 1
        raise FolderFormatError(path, f"line {line} is not UTF-8 text") from error
    return text.replace("\r\n", "\n").replace("\r", "\n") if "\r" in text else text


def _unique_keys(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    found = dict(pairs)
    if len(found) != len(pairs):
        double = next(key for key, _ in pairs if sum(key == other for other, _ in pairs) > 1)
        raise ValueError(f"the key '{double}' stands twice in one object")
    return found


def _no_constant(constant: str) -> Any:
    raise ValueError(f"{constant} is no JSON number")
