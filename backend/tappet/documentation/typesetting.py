"""Typesets one page in a process of its own: `python -m` with its limits, then the folder of `page.typ` and
what it reads.

Typst keeps what it has laid out for the next time, over 700 MiB after ten small projects, and gives nothing
back while its process lives. The file is `OUTPUT` in the folder; an error is JSON in `ERROR` there.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

from tappet.limited_process import run_limited, within_limits

PAGE, OUTPUT, ERROR = "page.typ", "made.pdf", "error.json"
TYPST_FONTS_ONLY = "--typst-fonts-only"
MEMORY_MIB = 3072
"""Some 80,000 lines of text; 30,000 take 1,060 MiB and 4 s."""
SECONDS = 120
THREADS = 4
"""Each has layouts and parts of the heap of its own, so that the memory would depend on the machine."""


class TypesettingError(Exception):
    """Typst refused the page: a message, and the diagnostic with the place."""

    def __init__(self, message: str, diagnostic: str = "") -> None:
        super().__init__(message)
        self.message, self.diagnostic = message, diagnostic


def typeset(folder: Path, *, system_fonts: bool) -> bytes:
    """The PDF of a folder; blocks. Raises TypesettingError and LimitExceededError."""
    done = run_limited(
        __name__,
        str(folder),
        *([] if system_fonts else [TYPST_FONTS_ONLY]),
        memory_mib=MEMORY_MIB,
        seconds=SECONDS,
        environment={"RAYON_NUM_THREADS": str(THREADS)},
    )
    if (folder / ERROR).exists():
        raise TypesettingError(**json.loads((folder / ERROR).read_text(encoding="utf-8")))
    if done.returncode:
        raise TypesettingError(f"its process ended with {done.returncode}")
    return (folder / OUTPUT).read_bytes()


def main(folder: Path, *options: str) -> None:
    """The process."""
    import typst

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
    with within_limits(*sys.argv[1:3]):
        main(Path(sys.argv[3]), *sys.argv[4:])
