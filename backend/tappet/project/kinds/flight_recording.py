"""A recording of the flight recorder: past cycles of a machine, kept with the project as a test."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import AfterValidator, Field, StrictBool

from tappet.project.data import ENCODED, MAX_TEXT, Data, Text
from tappet.project.object_kind import JsonFile, Naming, ObjectKind, Placement

_MARK = "TAPPET-FLIGHT "


def _recording(text: str) -> str:
    if text and not text.startswith(_MARK):
        raise ValueError("this is no recording of the flight recorder: its first line is another one")
    return text


class FlightRecordingData(Data):
    """The recording, as its file holds it, and what is expected of it."""

    recording: Annotated[
        str,
        Field(max_length=MAX_TEXT, json_schema_extra={ENCODED: "base64"}),
        AfterValidator(_recording),
    ] = ""
    """Text of the file (`runtime.flight_recording`)."""
    comment: Text = ""
    tested: StrictBool = True
    """Whether the tests of the application replay it on its present program."""
    expects: Literal["no_fault", "same_fault"] = "no_fault"
    """When that test is good: no fault comes any more, or the recorded one comes again."""


FLIGHT_RECORDING = ObjectKind(
    name="flight_recording",
    words="flight recording",
    description="Past cycles of a machine out of the flight recorder, kept with the project as a test.",
    data=FlightRecordingData,
    placement=Placement(parents=("application",)),
    naming=Naming(style="free", proposal="Recording", unique="place"),
    order=180,
    folder=JsonFile(texts={"recording": "flight"}),
    reported=True,
)
