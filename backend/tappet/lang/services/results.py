"""What the language services return. Ranges are in document coordinates."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Literal

from tappet.lang.services.documents import Place
from tappet.lang.source import Span


class ItemKind(StrEnum):
    """What a completion item or a symbol of the outline is."""

    PROGRAM = "program"
    FUNCTION = "function"
    FUNCTION_BLOCK = "function_block"
    METHOD = "method"
    ACTION = "action"
    PROPERTY = "property"
    INTERFACE = "interface"
    STRUCT = "struct"
    UNION = "union"
    ENUM = "enum"
    ENUM_VALUE = "enum_value"
    TYPE = "type"
    VARIABLE = "variable"
    PARAMETER = "parameter"
    CONSTANT = "constant"
    FIELD = "field"
    GLOBAL_LIST = "global_list"
    NAMESPACE = "namespace"
    KEYWORD = "keyword"
    OPERATOR = "operator"
    SNIPPET = "snippet"
    ATTRIBUTE = "attribute"
    LABEL = "label"
    SECTION = "section"


@dataclass(frozen=True, slots=True)
class Completion:
    """One proposal. `insert` may hold `$1 ${2:name} $0` places when `snippet` is set."""

    label: str
    kind: ItemKind
    detail: str = ""
    comment: str = ""
    insert: str | None = None
    snippet: bool = False
    rank: int = 5
    """0 (fits best) to 9; equal ranks are sorted by `order`, then by label."""
    order: int = 0
    deprecated: bool = False
    over: int = 0
    """Characters before the word that the proposal replaces as well."""
    library: str = ""
    """Whose comment it is; empty for one of the project."""


@dataclass(frozen=True, slots=True)
class Hover:
    """Explanation of what stands at a position: `code` is ST, `text` prose in Markdown."""

    span: Span
    code: str
    text: str = ""


@dataclass(frozen=True, slots=True)
class Reference:
    """A place that names something."""

    place: Place
    role: Literal["declaration", "read", "write", "call", "address"]


@dataclass(frozen=True, slots=True)
class CrossReference:
    """A place that names something, for a list over the project."""

    place: Place
    role: Literal["declaration", "read", "write", "call", "address"]
    symbol: str
    """What is named, with its owner: `PLC_PRG.iCount`."""
    text: str
    """The line of the place."""


@dataclass(frozen=True, slots=True)
class Edit:
    """Replace a range by a text."""

    place: Place
    text: str


@dataclass(frozen=True, slots=True)
class Outline:
    """One entry of the outline of a document."""

    name: str
    kind: ItemKind
    detail: str
    span: Span
    name_span: Span
    children: list[Outline] = field(default_factory=list)


@dataclass(frozen=True, slots=True)
class Parameter:
    """One parameter of a signature; `start` and `end` are its range in the label."""

    start: int
    end: int
    comment: str
    library: str = ""
    """Whose comment it is; empty for one of the project."""


@dataclass(frozen=True, slots=True)
class Signature:
    """The call at a position: its head, and the parameter that is being written (None: none of them)."""

    label: str
    comment: str
    parameters: list[Parameter]
    active: int | None
    library: str = ""
    """Whose comment it is; empty for one of the project."""


@dataclass(frozen=True, slots=True)
class RelatedReport:
    """Another place that explains a message."""

    place: Place
    message: str


@dataclass(frozen=True, slots=True)
class Report:
    """A diagnostic at its place in a document."""

    span: Span
    code: str
    severity: Literal["error", "warning", "info"]
    message: str
    advice: str
    related: tuple[RelatedReport, ...] = ()
    facts: Mapping[str, str] = field(default_factory=dict, compare=False)
    """What the message is about, as `Diagnostic.facts`."""
    element: str | None = None
    """Id of the element in a document that is drawn."""


@dataclass(frozen=True, slots=True)
class NewMember:
    """A method or property to be made below a block, with its heads as ST."""

    kind: Literal["method", "property"]
    name: str
    declaration: str
    accessors: tuple[str, ...] = ()
    """`Get`, `Set`: of a property."""


@dataclass(frozen=True, slots=True)
class CodeAction:
    """Something that mends a message. What is done is `edits`, or what the other fields name."""

    title: str
    key: str
    """Short name of the kind of action, so that an editor can say it in the user's language."""
    values: tuple[tuple[str, str], ...]
    """What the title names."""
    report: Report
    """The message that it mends."""
    edits: tuple[Edit, ...] = ()
    preferred: bool = False
    declare: str = ""
    """Name to ask the user a declaration for."""
    type: str = ""
    """Proposal for its type."""
    library: str = ""
    """Library that the application should refer to."""
    members: tuple[NewMember, ...] = ()
    """To be made below the object that shows `owner`."""
    owner: str = ""


@dataclass(frozen=True, slots=True)
class Fold:
    """Lines that can be folded together, both 0-based and included."""

    start: int
    end: int
    kind: Literal["region", "comment", "code"]


class ServiceError(ValueError):
    """A request that cannot be carried out; the text says why and what would be possible."""
