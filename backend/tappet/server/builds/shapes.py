"""Building an application and bringing it into a runtime."""

from __future__ import annotations

from enum import StrEnum
from typing import ClassVar, Literal

from pydantic import Field, PrivateAttr

from tappet.codegen.variable_changes import Effect, Reason
from tappet.lang.diagnostic_translations import Texts, said
from tappet.server.shapes import Reply, Request
from tappet.server.source.shapes import StoredSource
from tappet.translation.language import Language


class Part(StrEnum):
    """Which text of an object."""

    DECLARATION = "declaration"
    IMPLEMENTATION = "implementation"


class Severity(StrEnum):
    """How bad."""

    ERROR = "error"
    WARNING = "warning"
    INFO = "info"


class Diagnostic(Reply):
    """A message of the compiler with its place; lines and columns count from 1."""

    code: str = Field(description="Code of the table of diagnostics, such as `E0204`.")
    severity: Severity
    message: str
    advice: str | None
    object_id: str | None = Field(description="Null for library texts and for the application as a whole.")
    object_path: str
    part: Part | None
    element: str | None = Field(default=None, description="Id of the element in a drawn part.")
    line: int | None
    column: int | None
    end_line: int | None
    end_column: int | None
    _facts: dict[str, str] = PrivateAttr(default_factory=dict)

    def keep_facts(self, facts: dict[str, str]) -> None:
        """What the message is about, for `in_language`."""
        self._facts = facts

    def in_language(self, language: Language) -> Diagnostic:
        """The message in the words of a language."""
        message, advice = said(self.code, Texts(self.message, self.advice or ""), self._facts, language)
        return self.model_copy(update={"message": message, "advice": advice or None})


class BuildReport(Reply):
    """What came out of a build."""

    ok: bool
    diagnostics: list[Diagnostic]
    code_id: str | None
    data_id: str | None
    code_size: int | None = Field(description="Bytes of machine code and constants.")
    data_size: int | None = Field(description="Bytes of the variable image.")
    seconds: float

    def in_language(self, language: Language) -> BuildReport:
        """The report with its messages in the words of a language."""
        return self.model_copy(update={"diagnostics": [d.in_language(language) for d in self.diagnostics]})


class Relation(StrEnum):
    """How the application of the project relates to the one in the runtime."""

    SAME = "same"
    ONLINE_CHANGE = "online_change"
    DOWNLOAD = "download"
    FOREIGN = "foreign"
    EMPTY = "empty"


class LoginTarget(Request):
    """The runtime to log in to."""

    runtime_id: str


class ChangedVariable(Reply):
    """What an online change does to one variable, and why."""

    path: str
    effect: Effect = Field(
        description="`initialised`: begins with its initial value; `converted`: its value comes to the new "
        "type where it fits; `moved`: keeps its value at another place; `kept`: stays, without the initial "
        "value that is now declared; `lost`: is there no more; `cleared`: a pointer that becomes 0 where it "
        "points to what is lost; `follows`: one that is changed where it points to what moves."
    )
    reason: Reason
    type: str = Field(description="Afterwards; that before, for a variable that is lost.")
    before: str = Field(description="The type before, where it is another one.")
    calls: list[str] = Field(description="Of FB_Exit, FB_Init and FB_Reinit, which are called.")
    remanent: bool = Field(description="RETAIN or PERSISTENT.")


class ReserveUse(Reply):
    """The memory that the last download has set aside for online changes; in bytes."""

    used: int = Field(description="Taken by online changes so far.")
    needed: int = Field(description="Taken after this one.")
    reserved: int = Field(description="In all.")


class PersistentChange(Reply):
    """A persistent variable whose value a download cannot keep."""

    path: str
    reason: Literal["removed", "type_changed"]


class LoginReport(Reply):
    """Whether values may be shown at once, and what must be loaded first otherwise."""

    SENTENCES: ClassVar = ("reasons",)

    relation: Relation
    reasons: list[str] = Field(description="What differs, one sentence each.")
    changes: list[ChangedVariable] = Field(
        default=[], description="What an online change does to the variables, in the order of declarations."
    )
    changes_omitted: int = Field(default=0, description="Variables beyond those of the list.")
    reserve: ReserveUse | None = Field(
        default=None, description="For an online change: how much of the reserved memory it takes."
    )
    persistent: list[PersistentChange] = Field(
        default=[],
        description="Persistent variables that a download cannot keep: renamed, removed, or of another type.",
    )
    retain_layout_changes: bool = Field(
        default=False,
        description="Whether RETAIN or PERSISTENT variables come, go or get another place or type: the "
        "retain file is written anew with the values that are kept.",
    )
    loaded_project: str | None = Field(
        default=None, description="Name of the project that the runtime's application came from, when known."
    )


class LoadOrder(Request):
    """How to bring an application into the runtime."""

    runtime_id: str
    mode: Literal["download", "online_change"]
    start: bool = Field(default=True, description="Start after a download; an online change never stops.")
    initialise_persistent: bool = Field(
        default=False,
        description="Give all persistent variables their initial values: a reset origin before a download.",
    )


class DownloadOrder(LoadOrder):
    """How to bring the built application into the runtime."""

    source: bool | None = Field(
        default=None,
        description="Store the source of the project in the controller, too; null: as the application says.",
    )


class DownloadReport(Reply):
    """What the runtime now has."""

    SENTENCES: ClassVar = ("source_problem",)

    application: str
    code_id: str
    data_id: str
    state: str
    source: StoredSource | None = Field(default=None, description="The source, where it was stored.")
    source_problem: str | None = Field(
        default=None, description="Why the source was not stored; the application was loaded all the same."
    )
