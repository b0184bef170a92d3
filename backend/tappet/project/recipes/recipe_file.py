"""Recipe files as text: a line a variable, `Path:=value`, as controllers and CODESYS write them.

The library Recipe Management reads and writes the same format in the controller (`RecipeFile.st`).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from tappet.project.naming import name_key
from tappet.project.recipes.definition import RecipeDefinitionData, RecipeManagerData, RecipeVariable
from tappet.project.recipes.literals import form_of


class RecipeFileError(ValueError):
    """A line of a file is wrong; `line` counts from 1."""

    def __init__(self, line: int, message: str) -> None:
        super().__init__(message)
        self.line = line


@dataclass(slots=True)
class RecipeFileValues:
    """What a file holds for a definition."""

    values: dict[str, str] = field(default_factory=dict)
    """Literals by the paths of the definition."""
    unknown: list[str] = field(default_factory=list)
    """Paths that the definition does not have."""
    missing: list[str] = field(default_factory=list)
    """Variables of the definition that the file does not have."""


def write_recipe(
    manager: RecipeManagerData,
    definition: RecipeDefinitionData,
    values: Mapping[str, str],
    types: Mapping[str, str] | None = None,
) -> str:
    """The file of a recipe; variables without a value are left out."""
    lines = []
    for variable in definition.variables:
        value = values.get(variable.path, "")
        if value:
            texts = _columns(variable, value, (types or {}).get(variable.path, ""))
            lines.append(manager.separator.join(texts[column] for column in manager.columns))
    return "".join(f"{line}\r\n" for line in lines)


def _columns(variable: RecipeVariable, value: str, type_name: str) -> dict[str, str]:
    return {
        "variable": variable.path,
        "type": type_name,
        "name": variable.name,
        "minimum": variable.minimum,
        "maximum": variable.maximum,
        "comment": variable.comment,
        "value": value,
    }


def read_recipe(manager: RecipeManagerData, definition: RecipeDefinitionData, text: str) -> RecipeFileValues:
    """The values of a file. Raises RecipeFileError at the first line that is wrong."""
    known = {name_key(variable.path): variable.path for variable in definition.variables}
    found = RecipeFileValues()
    at_path, at_value = manager.columns.index("variable"), manager.columns.index("value")
    for number, line in enumerate(text.removeprefix("\ufeff").splitlines(), start=1):
        if not line.strip():
            continue
        parts = list(_split(line, manager.separator, len(manager.columns)))
        if len(parts) <= max(at_path, at_value):
            raise RecipeFileError(
                number,
                f"there are {len(parts)} of {len(manager.columns)} columns; they are separated by "
                f"'{manager.separator}'",
            )
        path, value = parts[at_path].strip(), parts[at_value].strip()
        if form_of(value) == "wrong":
            raise RecipeFileError(number, f"'{value}' is no value for {path}; write an IEC literal")
        own = known.get(name_key(path))
        if own is None:
            found.unknown.append(path)
        elif own in found.values:
            raise RecipeFileError(number, f"{path} is there twice; keep one line")
        else:
            found.values[own] = value
    found.missing = [path for path in known.values() if path not in found.values]
    if manager.exact_match and (found.unknown or found.missing):
        if found.unknown:
            message = (
                f"{found.unknown[0]} is not in the definition, and the recipe manager wants an exact match"
            )
        else:
            message = f"{found.missing[0]} is not in the file, and the recipe manager wants an exact match"
        raise RecipeFileError(0, message)
    return found


def _split(line: str, separator: str, most: int) -> Iterator[str]:
    """The columns of a line; a separator between quotes is none."""
    start = at = 0
    quote = ""
    count = 1
    while at < len(line):
        letter = line[at]
        if quote:
            if letter == "$":
                at += 1
            elif letter == quote:
                quote = ""
        elif letter in "'\"":
            quote = letter
        elif count < most and line.startswith(separator, at):
            yield line[start:at]
            at += len(separator)
            start = at
            count += 1
            continue
        at += 1
    yield line[start:]
