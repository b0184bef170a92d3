"""Typesets one page in a process of its own: `python -m` with the folder of `page.typ` and what it reads.

Typst keeps what it has laid out for the next time, over 700 MiB after ten small projects, and gives nothing
back while its process lives. The file is `OUTPUT` in the folder; an error is JSON in `ERROR` there.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from contextlib import suppress
from pathlib import Path

PAGE, OUTPUT, ERROR = "page.typ", "made.pdf", "error.json"
TYPST_FONTS_ONLY = "--typst-fonts-only"
BEHIND_OTHERS = 5
"""Niceness: a server, its compilers and the soft PLC come first."""


class TypesettingError(Exception):
    """Typst refused the page: a message, and the diagnostic with the place."""

    def __init__(self, message: str, diagnostic: str = "") -> None:
        super().__init__(message)
        self.message, self.diagnostic = message, diagnostic


def typeset(folder: Path, *, system_fonts: bool) -> bytes:
    """The PDF of a folder; blocks. Raises TypesettingError."""
    options = [] if system_fonts else [TYPST_FONTS_ONLY]
    command = [sys.executable, "-m", __name__, str(folder), *options]
    done = subprocess.run(command, stdin=subprocess.DEVNULL, check=False)  # noqa: S603 - our own program
    if (folder / ERROR).exists():
        raise TypesettingError(**json.loads((folder / ERROR).read_text(encoding="utf-8")))
    if done.returncode:
        raise TypesettingError(f"its process ended with {done.returncode}")
    return (folder / OUTPUT).read_bytes()


def main(folder: Path, *options: str) -> None:
    """The process."""
    import typst

    with suppress(OSError):
        os.nice(BEHIND_OTHERS)
    try:
        # the archive standard PDF/A-2u refuses characters without a glyph instead of drawing boxes
        typst.compile(
            folder / PAGE,
            folder / OUTPUT,
            root=folder,
            ignore_system_fonts=TYPST_FONTS_ONLY in options,
            pdf_standards=["a-2u"],
            pdf_tags=False,
        )
    except typst.TypstError as error:
        found = {"message": error.message, "diagnostic": error.diagnostic}
        (folder / ERROR).write_text(json.dumps(found), encoding="utf-8")


if __name__ == "__main__":
    main(Path(sys.argv[1]), *sys.argv[2:])
