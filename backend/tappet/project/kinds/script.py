"""A script of a user: an ES module that the workbench runs over the REST API (docs/scripts.md).

The project keeps it and nothing of the server or of a runtime ever runs it.
"""

from __future__ import annotations

from typing import Annotated

from pydantic import AfterValidator, Field

from tappet.project.data import Data, Text
from tappet.project.object_kind import POUS_VIEW, JsonFile, Naming, ObjectKind, Placement

MOST_CHARACTERS = 256 * 1024


def _short_enough(text: str) -> str:
    if len(text) > MOST_CHARACTERS:
        raise ValueError(f"the script has {len(text)} characters; at most {MOST_CHARACTERS} are kept")
    return text


class ScriptData(Data):
    """A script."""

    text: Annotated[Text, AfterValidator(_short_enough)] = Field(
        default="", description="An ES module; `tappet` in it is the API of the workbench."
    )


BEGINNING = """// Scripts run in the browser with your rights: Tools > Scripts.
const objects = await tappet.get(`/projects/${tappet.projectId}/objects`);
tappet.log(`${objects.length} objects`);
"""

SCRIPT = ObjectKind(
    name="script",
    words="script",
    description="A script of a user, which the workbench runs over the REST API.",
    data=ScriptData,
    placement=Placement(parents=(POUS_VIEW,)),
    naming=Naming(style="free", proposal="Script", unique="place"),
    order=180,
    new=lambda _name: ScriptData(text=BEGINNING),
    folder=JsonFile(optional=True, texts={"text": "js"}),
)
