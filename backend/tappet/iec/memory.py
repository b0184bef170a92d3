"""Limits of memory: the image, which holds all data of an application, and the stack of a task."""

from __future__ import annotations

from dataclasses import dataclass

MAX_IMAGE = 1 << 30
"""Largest accepted memory image in bytes; the image has to lie below 2 GiB."""

KIB = 1024
LARGEST_RESERVE_KIB = MAX_IMAGE // KIB


@dataclass(frozen=True, slots=True)
class ChangeReserve:
    """Memory that a download sets aside for what online changes add; it counts only when it is used."""

    percent: int = 100
    """Of the data of the application."""
    least: int = 1 << 20
    """Bytes at least."""

    def room(self, size: int) -> int:
        """Bytes beside `size` bytes of data."""
        return max(0, min(max(size * self.percent // 100, self.least), MAX_IMAGE - size))


DEFAULT_RESERVE = ChangeReserve()

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
