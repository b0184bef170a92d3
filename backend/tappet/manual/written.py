"""All files of the manual that are made, and writing them."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from tappet.manual.chart import chart
from tappet.manual.compliance import statements
from tappet.manual.examples import Example, read_examples
from tappet.manual.pages import FOLDERS, examples_of, pages
from tappet.manual.recording import Recording, record

MADE = (
    "blocks/*.md",
    "blocks/zh/*.md",
    "blocks/charts/*.svg",
    "cam-builder/*.md",
    "cam-builder/zh/*.md",
    "cnc/*.md",
    "cnc/zh/*.md",
    "plcopen-compliance.md",
    "zh/plcopen-compliance.md",
)
"""What no hand writes."""


def made(recordings: Iterable[Recording]) -> dict[str, str]:
    """Text of every file by its path in the folder of the manual."""
    recorded = list(recordings)
    examples = {recording.example.name: recording.example for recording in recorded}
    files = statements()
    for library in FOLDERS:
        files |= pages(library, examples)
    for recording in recorded:
        if recording.example.charted:
            files[f"blocks/charts/{recording.example.name}.svg"] = chart(recording)
    return files


def all_examples(folder: Path) -> dict[str, Example]:
    """The examples of all libraries in the folder of the manual."""
    return {
        name: one for library in FOLDERS for name, one in read_examples(folder / examples_of(library)).items()
    }


def stored(folder: Path) -> dict[str, str]:
    """The same as it lies there."""
    return {
        path.relative_to(folder).as_posix(): path.read_text(encoding="utf-8")
        for pattern in MADE
        for path in folder.glob(pattern)
    }


def write(folder: Path) -> None:
    """Writes what is made and removes what is made no more."""
    files = made(record(all_examples(folder)))
    for name in stored(folder).keys() - files.keys():
        (folder / name).unlink()
    for name, text in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
