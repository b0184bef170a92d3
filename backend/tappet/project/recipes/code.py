"""What the compiler is given of a recipe manager: a function block of each definition, and an instance of it.

The blocks say what stands in the definitions; everything else is in the library Recipe Management. A function
that nobody calls assigns each value to its variable, so that the compiler says which does not fit.
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Iterable

from tappet.project.axes.variables import NOT_WRITTEN_BY_HAND
from tappet.project.model import ProjectObject
from tappet.project.recipes.definition import (
    Column,
    RecipeDefinitionData,
    RecipeManagerData,
    RecipeVariable,
)
from tappet.project.recipes.literals import form_of, narrow, st_string
from tappet.project.source_text import SourceWriter

LIBRARY = "Recipe Management"
NAMESPACE = "RecipeManagement"
VARIABLES = "IoConfig_Recipes"
COLUMNS: dict[Column, str] = {
    "variable": "Variable",
    "type": "DataType",
    "name": "Name",
    "minimum": "Minimum",
    "maximum": "Maximum",
    "comment": "Comment",
    "value": "Value",
}
_NOTES: tuple[tuple[str, Callable[[RecipeVariable], str]], ...] = (
    ("Name", lambda variable: variable.name),
    ("Minimum", lambda variable: narrow(variable.minimum)),
    ("Maximum", lambda variable: narrow(variable.maximum)),
    ("Comment", lambda variable: variable.comment),
)


def write_definitions(
    manager: RecipeManagerData, definitions: list[ProjectObject], writer: SourceWriter
) -> None:
    """All definitions of a manager."""
    writer.name = VARIABLES
    for item in definitions:
        data = item.data_as(RecipeDefinitionData)
        _write_block(manager, item, data, writer)
        _write_check(item, data, writer)
    writer.keyword(f"{NOT_WRITTEN_BY_HAND}\nVAR_GLOBAL")
    for item in definitions:
        writer.keyword(f"    _RecipeDefinition_{item.name} : RecipeDefinition_{item.name};")
    writer.keyword("END_VAR")


def _write_block(
    manager: RecipeManagerData, item: ProjectObject, data: RecipeDefinitionData, writer: SourceWriter
) -> None:
    writer.keyword(f"{NOT_WRITTEN_BY_HAND}\n{{attribute 'hide'}}")
    head = f"FUNCTION_BLOCK RecipeDefinition_{item.name} EXTENDS {NAMESPACE}.RecipeDefinition"
    writer.part(item.id, "declaration", head)
    writer.keyword("METHOD PROTECTED Describe")
    writer.keyword("\n".join(f"{name} := {value};" for name, value in _facts(manager, item, data)))
    writer.keyword("END_METHOD\n\nMETHOD PROTECTED Bind")
    for number, variable in enumerate(data.variables):
        text = f"Bound({number}, {variable.path});"
        if not _is_path(variable.path):
            text = f"{{error 'no path of a variable: {_quoted(variable.path)}'}}"
        writer.element(item.id, variable.path, text)
    writer.keyword("END_METHOD\n")
    _write_choices(
        "METHOD PathOf : STRING(255)\nVAR_INPUT\n    diVariable : DINT;\nEND_VAR",
        "PathOf",
        ((number, st_string(variable.path)) for number, variable in enumerate(data.variables)),
        writer,
    )
    writer.keyword(
        "METHOD NoteOf : STRING(255)\nVAR_INPUT\n    diVariable : DINT;\n"
        f"    eColumn : {NAMESPACE}.RecipeColumn;\nEND_VAR"
    )
    for name, of in _NOTES:
        found = [(number, of(variable)) for number, variable in enumerate(data.variables)]
        found = [(number, text) for number, text in found if text]
        if found:
            writer.keyword(f"IF eColumn = {NAMESPACE}.RecipeColumn.{name} THEN")
            _write_case("diVariable", "NoteOf", ((n, st_string(text)) for n, text in found), writer)
            writer.keyword("END_IF")
    writer.keyword("END_METHOD\n")
    _write_choices(
        "METHOD PROTECTED GivenName : STRING(80)\nVAR_INPUT\n    diRecipe : DINT;\nEND_VAR",
        "GivenName",
        ((number, st_string(recipe.name)) for number, recipe in enumerate(data.recipes)),
        writer,
    )
    writer.keyword(
        "METHOD PROTECTED GivenValue : STRING(255)\n"
        "VAR_INPUT\n    diRecipe : DINT;\n    diVariable : DINT;\nEND_VAR"
    )
    if data.recipes:
        writer.keyword("CASE diRecipe OF")
        for number, recipe in enumerate(data.recipes):
            writer.keyword(f"{number}:")
            given = (
                (row, _value_text(recipe.values[variable.path]))
                for row, variable in enumerate(data.variables)
                if recipe.values.get(variable.path)
            )
            _write_case("diVariable", "GivenValue", given, writer)
        writer.keyword("END_CASE")
    writer.keyword("END_METHOD\nEND_FUNCTION_BLOCK\n")


def _facts(
    manager: RecipeManagerData, item: ProjectObject, data: RecipeDefinitionData
) -> Iterable[tuple[str, str]]:
    state = hashlib.blake2s(data.model_dump_json().encode(), digest_size=16).hexdigest()
    yield "sName", st_string(item.name)
    yield "sState", f"'{state}'"
    yield "diVariables", str(len(data.variables))
    yield "diGiven", str(len(data.recipes))
    yield "sFolder", st_string(manager.folder)
    yield "sExtension", st_string(manager.extension)
    yield "sSeparator", st_string(manager.separator)
    for number, column in enumerate(manager.columns):
        yield f"aeColumns[{number}]", f"{NAMESPACE}.RecipeColumn.{COLUMNS[column]}"
    for name, flag in (
        ("xBinary", manager.storage == "binary"),
        ("xInPlc", manager.in_controller),
        ("xAutoSave", manager.save_changes),
        ("xLoadAtStart", manager.load_at_start),
        ("xExact", manager.exact_match),
    ):
        yield name, str(flag).upper()


def _write_choices(head: str, result: str, choices: Iterable[tuple[int, str]], writer: SourceWriter) -> None:
    writer.keyword(head)
    subject = "diVariable" if "diVariable" in head else "diRecipe"
    _write_case(subject, result, choices, writer)
    writer.keyword("END_METHOD\n")


def _write_case(subject: str, result: str, choices: Iterable[tuple[int, str]], writer: SourceWriter) -> None:
    rows = [f"    {number}: {result} := {value};" for number, value in choices]
    if rows:
        writer.keyword("\n".join([f"CASE {subject} OF", *rows, "END_CASE"]))


def _value_text(text: str) -> str:
    """What the block tells of a value: the number of a constant is found out by the compiler."""
    text = text.strip()
    if form_of(text) == "name":
        return f"LINT_TO_STRING(TO_LINT({text.replace('#', '.')}))"
    return st_string(narrow(text)) if form_of(text) == "literal" else "''"


def _write_check(item: ProjectObject, data: RecipeDefinitionData, writer: SourceWriter) -> None:
    """Assignments that are compiled, and never run."""
    writer.keyword(
        f"{NOT_WRITTEN_BY_HAND}\n{{attribute 'hide'}}\n{{attribute 'tappet_value_check'}}\n"
        f"FUNCTION RecipeCheck_{item.name} : BOOL"
    )
    rows = [variable for variable in data.variables if _is_path(variable.path)]
    if rows:
        writer.keyword("VAR\n    sText : STRING;\nEND_VAR")
    for variable in rows:
        # only elementary types have texts
        writer.element(item.id, variable.path, f"sText := TO_STRING({variable.path});")
        for what, text in (("minimum", variable.minimum), ("maximum", variable.maximum)):
            _write_assignment(item, variable.path, what, text, writer)
        for recipe in data.recipes:
            _write_assignment(
                item, variable.path, f"recipe {recipe.name}", recipe.values.get(variable.path, ""), writer
            )
    writer.keyword(f"RecipeCheck_{item.name} := TRUE;\nEND_FUNCTION\n")


def _write_assignment(item: ProjectObject, path: str, what: str, text: str, writer: SourceWriter) -> None:
    text = text.strip()
    if not text:
        return
    if form_of(text) == "wrong":
        line = f"{{error '{_quoted(what)}: no value: {_quoted(text)}'}}"
    else:
        line = f"{path} := {text};"
    writer.element(item.id, f"{path} / {what}", line)


def _is_path(text: str) -> bool:
    """Names behind dots, with indices; a compiler says whether there is such a variable."""
    name, _, rest = text.partition("[")
    if form_of(name) != "name" or "#" in name:
        return False
    return not rest or all(letter.isalnum() or letter in "_[],.-: " for letter in rest)


def _quoted(text: str) -> str:
    return "".join(letter if letter.isprintable() and letter not in "'$}{" else "?" for letter in text)
