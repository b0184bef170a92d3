"""What can go wrong with a project; every message says what, where, and what would be right."""

from __future__ import annotations


class ProjectError(Exception):
    """A request that the project cannot fulfil; `str(error)` is a sentence for the user."""

    code = "project_error"
    """Stable name of the kind of error, for programs."""


class UnknownObjectError(ProjectError):
    """No object with this id or path."""

    code = "unknown_object"


class InvalidNameError(ProjectError):
    """The name is no identifier, is reserved, or has characters that names cannot have."""

    code = "invalid_name"


class NameTakenError(ProjectError):
    """Another object of the same place has this name (names differ by more than case)."""

    code = "name_taken"


class NotPlaceableError(ProjectError):
    """An object of this kind cannot be at this place."""

    code = "not_placeable"


class NeededObjectError(ProjectError):
    """An object cannot be deleted as long as others need it."""

    code = "needed_object"


class InvalidDataError(ProjectError):
    """The data of an object do not fit its kind."""

    code = "invalid_data"


class InvalidTimeError(ProjectError):
    """A text is no TIME literal and no number of microseconds."""

    code = "invalid_time"


class FolderFormatError(ProjectError):
    """A project folder or archive cannot be read; the message begins with the path of the file."""

    code = "folder_format"

    def __init__(self, path: str, message: str) -> None:
        super().__init__(f"{path}: {message}")
        self.path = path
