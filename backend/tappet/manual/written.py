"""All files of the manual that are made, and writing them."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from tappet.manual.chart import chart
from tappet.manual.compliance import statements
from tappet.manual.examples import read_examples
from tappet.manual.pages import pages
from tappet.manual.recording import Recording, record

MADE = (
    "blocks/*.md",
    "blocks/zh/*.md",
    "blocks/charts/*.svg",
    "plcopen-compliance.md",
    "zh/plcopen-compliance.md",
)
"""What no hand writes."""


def made(recordings: Iterable[Recording]) -> dict[str, str]:
    """Text of every file by its path in the folder of the manual."""
    recorded = list(recordings)
    examples = {recording.example.name: recording.example for recording in recorded}
    files = {f"blocks/{name}": text for name, text in pages(examples).items()}
    files |= statements()
    for recording in recorded:
        if recording.example.charted:
            files[f"blocks/charts/{recording.example.name}.svg"] = chart(recording)
    return files


def stored(folder: Path) -> dict[str, str]:
    """The same as it lies there."""
    return {
        path.relative_to(folder).as_posix(): path.read_text(encoding="utf-8")
        for pattern in MADE
        for path in folder.glob(pattern)
    }


def write(folder: Path) -> None:
    """Writes what is made and removes what is made no more."""
    files = made(record(read_examples(folder / "examples")))
    for name in stored(folder).keys() - files.keys():
        (folder / name).unlink()
    for name, text in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
