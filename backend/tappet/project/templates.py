"""What new objects begin with: the templates of their kinds."""

from __future__ import annotations

from tappet.iec.languages import offered as offered_languages
from tappet.project.data import Data
from tappet.project.errors import InvalidDataError
from tappet.project.kind_registry import kinds


def new_data(kind: str, name: str, subkind: str | None = None, language: str | None = None) -> Data:
    """The data of a new object. `subkind` chooses among the templates of its kind, the first by default;
    `language` is the one of its body (FBD-02).

    Raises InvalidDataError for a subkind or a language that the kind does not have.
    """
    known = kinds().get(kind)
    if known is None:
        raise InvalidDataError(f"Objects of kind '{kind}' belong to a plug-in that is not installed")
    if subkind is not None and subkind not in known.templates:
        offered = ", ".join(known.templates) or "none"
        raise InvalidDataError(f"A new {known.words} cannot be a '{subkind}'; possible: {offered}")
    template = known.templates[subkind or next(iter(known.templates))] if known.templates else known.new
    data: Data = template(name) if template is not None else known.data()
    if language is None:
        return data
    languages = offered_languages() if known.written else ()
    if language not in languages:
        possible = ", ".join(languages) or "none"
        raise InvalidDataError(f"A new {known.words} cannot be written in '{language}'; possible: {possible}")
    return data.model_copy(update={"language": language})
