"""A small picture in the data of an object: PNG or JPEG as base64, decoded once before it is taken.

Cost: the decoder is imported with the first picture of a process; what was found is kept for the last few.
"""

from __future__ import annotations

import base64
import binascii
import io
import warnings
from functools import lru_cache
from typing import Annotated, Literal, NamedTuple

from pydantic import AfterValidator

MOST_BYTES = 256 * 1024
_MOST_CHARACTERS = -(-MOST_BYTES // 3) * 4
MOST_PIXELS = 4000
"""Of a side."""
FORMATS: dict[str, tuple[bytes, Literal["image/png", "image/jpeg"], Literal["png", "jpg"]]] = {
    "PNG": (b"\x89PNG\r\n\x1a\n", "image/png", "png"),
    "JPEG": (b"\xff\xd8\xff", "image/jpeg", "jpg"),
}
"""Signature, media type and ending of a file."""


class Picture(NamedTuple):
    """A picture that can be shown."""

    media_type: Literal["image/png", "image/jpeg"]
    ending: Literal["png", "jpg"]
    width: int
    """In pixels."""
    height: int
    content: bytes


@lru_cache(maxsize=8)
def read_picture(text: str) -> Picture:
    """The picture that a text in base64 holds. Raises ValueError, which says what is wrong with it."""
    if len(text) > _MOST_CHARACTERS:
        raise ValueError(f"the picture has more than {MOST_BYTES:,} bytes (256 KiB); make it smaller")
    try:
        content = base64.b64decode(text, validate=True)
    except (binascii.Error, ValueError):
        raise ValueError("the picture is no base64 without line breaks") from None
    form = next((name for name, (begin, *_) in FORMATS.items() if content.startswith(begin)), None)
    if form is None:
        raise ValueError(f"the picture is neither PNG nor JPEG{_hint(content)}: convert it")
    width, height = _decoded(content, form)
    return Picture(*FORMATS[form][1:], width, height, content)


def _decoded(content: bytes, form: str) -> tuple[int, int]:
    """Width and height of what the decoder reads to its end."""
    from PIL import Image

    width = height = MOST_PIXELS + 1
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            with Image.open(io.BytesIO(content), formats=[form]) as image:
                width, height = image.size
                if max(width, height) <= MOST_PIXELS:
                    image.load()
    except Image.DecompressionBombError:
        pass
    # a decoder of foreign bytes raises what it likes
    except Exception:
        raise ValueError(f"the picture begins like a {form} but cannot be decoded: it is damaged") from None
    if max(width, height) > MOST_PIXELS:
        raise ValueError(f"the picture has more than {MOST_PIXELS:,} pixels a side: make it smaller")
    return width, height


def _hint(content: bytes) -> str:
    begin = content[:256].lstrip().lower()
    if begin.startswith((b"<svg", b"<?xml", b"<!doctype svg")):
        return " but SVG, which can hold scripts"
    return next((f" but {name}" for sign, name in _OTHERS.items() if content.startswith(sign)), "")


_OTHERS = {b"GIF8": "GIF", b"BM": "BMP", b"RIFF": "WebP", b"II*\0": "TIFF", b"MM\0*": "TIFF", b"%PDF": "PDF"}


def _taken(text: str) -> str:
    read_picture(text)
    return text


Base64Picture = Annotated[str, AfterValidator(_taken)]
"""The text of `read_picture`."""
