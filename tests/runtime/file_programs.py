"""A program that reads CNC files of the folder of its soft PLC."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from typing import Self

from library_programs import compiled

from tappet.codegen.package import CodePackage
from tappet.runtime.local import LocalRuntime


@cache
def _package(text: str) -> CodePackage:
    return compiled(text, "SM3_Basic", "SM3_CNC")


class FileProgram:
    """The program, with the files of its runtime."""

    text: str
    """Of PLC_PRG."""

    def __init__(self, runtime: LocalRuntime, folder: Path) -> None:
        self.runtime = runtime
        self.folder = folder / "files"
        self.folder.mkdir(exist_ok=True)

    @classmethod
    @contextmanager
    def running(cls, folder: Path) -> Iterator[Self]:
        with LocalRuntime(_package(cls.text), folder=folder) as runtime:
            yield cls(runtime, folder)

    def literal(self, name: str) -> str:
        return self.runtime.literal(f"PLC_PRG.{name}")

    def set(self, **values: float | bool | str) -> None:
        self.runtime.write_all({f"PLC_PRG.{name}": value for name, value in values.items()})
