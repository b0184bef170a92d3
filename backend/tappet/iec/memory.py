"""Limits of memory: the image, which holds all data of an application, and the stack of a task."""

from __future__ import annotations

MAX_IMAGE = 1 << 30
"""Largest accepted memory image in bytes; the image has to lie below 2 GiB."""

STACK_SIZE = 1 << 20
"""Stack of a task in bytes: variables of functions and methods, and VAR_TEMP."""


class ImageTooLargeError(ValueError):
    """The data do not fit the largest image."""

    def __init__(self, size: int) -> None:
        super().__init__(f"the data need {size} bytes; the image holds {MAX_IMAGE}")


def check_image_size(size: int) -> None:
    """Raises ImageTooLargeError for data of more bytes than the largest image has."""
    if size > MAX_IMAGE:
        raise ImageTooLargeError(size)
