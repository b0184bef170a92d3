"""A 3D scene of a machine: elements with properties that are fixed or bound to variables.

A scene is data, never code: opening a project runs nothing (architecture, decision 16). Lengths are in
the unit of the machine (`unit` metres each, 0.001 for millimetres). `{i}` in a variable or name is the
index of a repetition.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import Field, model_validator

from tappet.project.data import Data

MOST_BODIES = 10_000
"""Single elements in a scene, repetitions counted one by one; more is no picture a page could keep moving."""
Finite = Annotated[float, Field(allow_inf_nan=False)]
Color = Annotated[str, Field(pattern=r"^#[0-9a-fA-F]{6}$")]


class Linear(Data):
    """offset + factor * variable, in the unit of the scene."""

    variable: str = Field(min_length=1)
    factor: Finite = 1.0
    offset: Finite = 0.0


class Threshold(Data):
    """TRUE while the variable is at least as large; BOOL counts as 0 or 1."""

    variable: str = Field(min_length=1)
    at_least: Finite | Literal["{i}"] = 1.0


class ColorChoice(Data):
    """One of two colours by a BOOL variable."""

    variable: str = Field(min_length=1)
    when_true: Color
    when_false: Color


class Repetition(Data):
    """The element stands once for each index from `first` to `last`."""

    first: int = Field(default=1, ge=-1000, le=1000)
    last: int = Field(ge=-1000, le=1000)

    @model_validator(mode="after")
    def _upwards(self) -> Repetition:
        if self.last < self.first:
            raise ValueError(
                f"a repetition from {self.first} to {self.last} is empty; last is the larger one"
            )
        return self


Number = Finite | Linear


class Element(Data):
    """One body. `position` is the centre of its bottom face, x along the machine, z up.

    `size` is x, y, z for a box, diameter x, diameter y, height for a cylinder or sphere; labels ignore it.
    """

    name: str = Field(min_length=1, max_length=60, pattern=r"^([A-Za-z0-9_ .-]|\{i\})+$")
    shape: Literal["box", "cylinder", "sphere", "label"]
    size: tuple[Number, Number, Number] = (1.0, 1.0, 1.0)
    position: tuple[Number, Number, Number] = (0.0, 0.0, 0.0)
    color: Color | ColorChoice = "#9aa0a6"
    opacity: float = Field(default=1.0, gt=0.0, le=1.0)
    visible: bool | Threshold = True
    text: str = Field(default="", max_length=200)
    value: str | None = None
    """Variable whose value takes the place of `{}` in `text`."""
    repeat: Repetition | None = None

    @model_validator(mode="after")
    def _index_needs_repetition(self) -> Element:
        bound = self.visible.at_least if isinstance(self.visible, Threshold) else None
        if self.repeat is None and (bound == "{i}" or "{i}" in self.name):
            raise ValueError(f"'{self.name}' uses the index {{i}} without a repetition")
        return self

    def names(self) -> list[str]:
        """Names of the single elements this one represents."""
        if self.repeat is None:
            return [self.name]
        return [_indexed_name(self.name, i) for i in range(self.repeat.first, self.repeat.last + 1)]


class Camera(Data):
    """Where the view starts, in scene units."""

    position: tuple[Finite, Finite, Finite]
    look_at: tuple[Finite, Finite, Finite]


class Scene(Data):
    """Elements in the order they are drawn."""

    unit: Finite = Field(default=0.001, gt=0.0)
    camera: Camera | None = None
    elements: tuple[Element, ...] = ()

    @model_validator(mode="after")
    def _bodies_can_be_told_apart(self) -> Scene:
        names = [name for element in self.elements for name in element.names()]
        if len(names) > MOST_BODIES:
            raise ValueError(f"the scene has {len(names)} bodies; at most {MOST_BODIES} can be drawn")
        seen: set[str] = set()
        for name in names:
            key = name.replace(" ", "_")
            if key in seen:
                raise ValueError(f"two bodies are named '{name}'; give each a name of its own")
            seen.add(key)
        return self

    def expanded(self) -> Iterator[Element]:
        """Every single element, repetitions written out with their index."""
        for element in self.elements:
            if element.repeat is None:
                yield element
                continue
            for i in range(element.repeat.first, element.repeat.last + 1):
                yield _with_index(element, i)

    def variables(self) -> list[str]:
        """All variables the scene is bound to, each once, in order of first use."""
        found: dict[str, None] = {}
        for element in self.expanded():
            for bound in (*element.size, *element.position, element.color, element.visible):
                if isinstance(bound, (Linear, Threshold, ColorChoice)):
                    found.setdefault(bound.variable)
            if element.value:
                found.setdefault(element.value)
        return list(found)


def _indexed_name(name: str, i: int) -> str:
    return name.replace("{i}", str(i)) if "{i}" in name else f"{name} {i}"


def _with_index(element: Element, i: int) -> Element:
    raw = element.model_dump(exclude={"repeat", "name"})

    def fill(node: object) -> object:
        if isinstance(node, str):
            return node.replace("{i}", str(i))
        if isinstance(node, dict):
            filled = {key: fill(value) for key, value in node.items()}
            if isinstance(filled.get("at_least"), str):
                filled["at_least"] = float(str(filled["at_least"]))
            return filled
        if isinstance(node, (tuple, list)):
            return tuple(fill(value) for value in node)
        return node

    filled = fill(raw)
    assert isinstance(filled, dict)
    filled["name"] = _indexed_name(element.name, i)
    return Element.model_validate(filled)
