"""Recipes between the definitions of a project, controllers and files."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from typing import Any

from tappet.codegen.package import CodePackage
from tappet.codegen.symbol_map import Child, SymbolError, SymbolMap
from tappet.project.kinds.application import APPLICATION
from tappet.project.model import ProjectObject
from tappet.project.naming import name_key
from tappet.project.recipes.definition import MOST_VARIABLES, Recipe, RecipeDefinitionData, RecipeManagerData
from tappet.project.recipes.recipe_file import RecipeFileError, RecipeFileValues, read_recipe, write_recipe
from tappet.project.store import Store
from tappet.server.problems import Problem
from tappet.server.recipes.shapes import RecipeVariables, RecipeVariableType
from tappet.server.runtimes.links import RuntimeLink
from tappet.server.shapes import InvalidField
from tappet.server.values import service as values
from tappet.server.values.shapes import NewValue, Value

MOST_FOUND = 500
MOST_WHOLES = 100
MOST_LOOKED_AT = 200_000
_NO_VALUES = frozenset({"pointer", "reference", "interface", "bit"})


@dataclass(frozen=True, slots=True)
class Definition:
    """A recipe definition with the settings of its manager."""

    item: ProjectObject
    data: RecipeDefinitionData
    manager: RecipeManagerData

    def recipe(self, name: str) -> Recipe:
        """The recipe of a name; a 404 problem if there is none."""
        for recipe in self.data.recipes:
            if name_key(recipe.name) == name_key(name):
                return recipe
        names = ", ".join(recipe.name for recipe in self.data.recipes) or "none"
        raise Problem(404, "no-such-recipe", f"{self.item.name} has no recipe '{name}'; it has {names}.")

    def with_values(self, name: str, found: dict[str, str]) -> RecipeDefinitionData:
        """The data with these values in a recipe, which is made if it is not there."""
        recipes = list(self.data.recipes)
        for at, recipe in enumerate(recipes):
            if name_key(recipe.name) == name_key(name):
                recipes[at] = recipe.model_copy(update={"values": recipe.values | found})
                break
        else:
            recipes.append(Recipe(name=name, values=found))
        return self.data.model_copy(update={"recipes": recipes})


def load(store: Store, project_id: str, definition_id: str) -> Definition:
    """A definition; a 404 problem when the object is none."""
    item = store.get(project_id, definition_id)
    if not isinstance(item.data, RecipeDefinitionData):
        raise Problem(404, "no-recipe-definition", f"'{item.name}' is no recipe definition.")
    manager = store.get(project_id, item.parent_id).data if item.parent_id else None
    if not isinstance(manager, RecipeManagerData):
        manager = RecipeManagerData()
    return Definition(item, item.data, manager)


async def read(link: RuntimeLink, definition: Definition) -> dict[str, str]:
    """The present values of all variables as literals; a 422 problem when one cannot be read."""
    found = await values.read(link, [variable.path for variable in definition.data.variables])
    errors = [InvalidField(location=v.expression, message=v.error) for v in found if v.error is not None]
    if errors:
        detail = f"{errors[0].location}: {errors[0].message} Nothing was read."
        raise Problem(422, "values-not-read", detail, errors=errors)
    symbols = link.loaded_symbols()
    return {value.expression: _written(symbols, value) for value in found}


def _written(symbols: SymbolMap, value: Value) -> str:
    """A value as recipes have it: that of an enumeration behind the name of its type."""
    literal = value.literal or ""
    ref = symbols.resolve(value.expression)
    if ref.type.kind == "enum" and literal.isidentifier():
        return f"{ref.type.name}.{literal}"
    return literal


def within_limits(
    link: RuntimeLink, definition: Definition, recipe: Recipe
) -> tuple[list[NewValue], list[str]]:
    """The values of a recipe within the limits of the definition, and the paths that were beyond them."""
    symbols = link.loaded_symbols()
    wanted, limited = [], []
    for variable in definition.data.variables:
        text = recipe.values.get(variable.path, "").strip()
        if not text:
            continue
        for limit, side in ((variable.minimum, -1), (variable.maximum, 1)):
            if limit and _beyond(symbols, variable.path, text, limit, side):
                text = limit
                limited.append(variable.path)
                break
        wanted.append(NewValue(expression=variable.path, value=text))
    if not wanted:
        raise Problem(422, "empty-recipe", f"The recipe '{recipe.name}' has no values; read some into it.")
    return wanted, limited


def _beyond(symbols: SymbolMap, path: str, text: str, limit: str, side: int) -> bool:
    """Whether a value is beyond a limit; what does not fit the variable is refused when it is written."""
    try:
        ref = symbols.resolve(path)
        value: Any = symbols.decode(ref, symbols.encode(ref, text))
        bound: Any = symbols.decode(ref, symbols.encode(ref, limit))
    except (SymbolError, ValueError):
        return False
    if not isinstance(value, int | float) or not isinstance(bound, int | float):
        return False
    return value < bound if side < 0 else value > bound


def same(symbols: SymbolMap, path: str, one: str, other: str | None) -> bool:
    """Whether two literals are the same value of a variable."""
    if other is None:
        return False
    try:
        ref = symbols.resolve(path)
        return symbols.encode(ref, one) == symbols.encode(ref, other)
    except (SymbolError, ValueError):
        return False


def application_of(store: Store, project_id: str, definition_id: str) -> str:
    """The application that a definition belongs to."""
    item = store.get(project_id, definition_id)
    while item.kind != APPLICATION.name:
        assert item.parent_id is not None, "a definition is below an application"
        item = store.get(project_id, item.parent_id)
    return item.id


def variables(package: bytes, definition: Definition, query: str, below: str = "") -> RecipeVariables:
    """The elementary variables of a package that have all words of a query in their paths."""
    symbols = CodePackage.from_bytes(package).symbols
    words = [word.upper() for word in query.split()]
    most = MOST_VARIABLES if below else MOST_FOUND
    found: list[RecipeVariableType] = []
    wholes: list[RecipeVariableType] = []
    more = False
    for number, child in enumerate(_variables(symbols, below)):
        fits = all(word in child.path.upper() for word in words)
        if number >= MOST_LOOKED_AT or (fits and len(found) == most):
            more = True
            break
        if fits and child.leaf:
            found.append(RecipeVariableType(path=child.path, type=child.type))
        elif fits and len(wholes) < MOST_WHOLES:
            wholes.append(RecipeVariableType(path=child.path, type=child.type))
    types = {}
    for variable in definition.data.variables:
        with suppress(SymbolError):
            types[variable.path] = symbols.resolve(variable.path).type.name
    return RecipeVariables(found=found, wholes=wholes, more=more, types=types)


def _variables(symbols: SymbolMap, path: str) -> Iterator[Child]:
    """What lies below a path, down to values; what is made of recipes and axes is left out."""
    try:
        children = symbols.children(path)
    except SymbolError:  # of what cannot be looked into
        return
    for child in children:
        if not path and child.name.startswith(("IoConfig_", "_")):
            continue
        if not child.leaf:
            members = _variables(symbols, child.path)
            if (first := next(members, None)) is not None:
                if path:
                    yield child
                yield first
                yield from members
        elif "CONSTANT" not in child.flags and child.kind not in _NO_VALUES and child.section != "VAR_IN_OUT":
            yield child


def from_file(definition: Definition, text: str) -> RecipeFileValues:
    """The values of a recipe file; a 422 problem that names the line that is wrong."""
    try:
        return read_recipe(definition.manager, definition.data, text)
    except RecipeFileError as error:
        where = f"line {error.line}" if error.line else "file"
        field = InvalidField(location=where, message=f"{error}.")
        raise Problem(422, "wrong-recipe-file", f"{where}: {error}.", errors=[field]) from error


def to_file(definition: Definition, recipe: Recipe) -> str:
    """The file of a recipe."""
    return write_recipe(definition.manager, definition.data, recipe.values)


def file_name(definition: Definition, recipe: Recipe) -> str:
    """What the file is called in the controller."""
    return f"{recipe.name}.{definition.item.name}.{definition.manager.extension}"
