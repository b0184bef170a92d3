"""Runs `SMC_CAMEvaluate` of SM3_Basic on a cam: what is drawn is what will run (architecture, decision 11).

The program is built once a process, in a second or two; with a folder of compiled objects much faster. A
question costs some 100 ns, a call some 0.1 ms beside that.
"""

from __future__ import annotations

from collections.abc import Sequence
from importlib.resources import files
from pathlib import Path
from types import TracebackType

import numpy as np
import numpy.typing as npt

from tappet.codegen.build import BuildOptions, LibraryReference, build_application
from tappet.codegen.package import CodePackage
from tappet.iec.task import Task
from tappet.lang.source import Source
from tappet.project.cams.code import LIBRARY
from tappet.project.cams.table import LAWS, MOST_POINTS, CamPoint, CamSegment
from tappet.runtime.flight import FlightSettings
from tappet.runtime.local import LocalRuntime

Numbers = npt.NDArray[np.float64]
Pieces = Sequence[tuple[CamPoint, CamSegment, CamPoint]]
QUESTIONS = 16_384
"""In one cycle of the program: MOST_QUESTIONS."""
_SEGMENT = np.dtype([("numbers", "<f8", 11), ("law", "<i2"), ("padding", "V6")])
"""SMC_CAM_SEGMENT: the states at both ends, the inflection point, the law."""


class CamProgram:
    """The program with one cam after the other in it. Not for several threads at once."""

    def __init__(self, cache: Path | None = None) -> None:
        """`cache` is a folder of compiled objects."""
        self._runtime = LocalRuntime(_built(cache), flight=FlightSettings(memory=0))
        application = self._runtime.plc.application
        assert application is not None
        self._image = application.image
        resolve = self._runtime.package.symbols.resolve
        self._segments, self._which, self._x = (
            resolve(f"Main.{name}").offset for name in ("aSegments", "aiSegment", "afX")
        )
        self._values, self._count = (resolve(f"Main.{name}").offset for name in ("aValues", "diCount"))
        if resolve("Main.aSegments").size != MOST_POINTS * _SEGMENT.itemsize:
            raise RuntimeError("SMC_CAM_SEGMENT of SM3_Basic is laid out in another way")

    def __enter__(self) -> CamProgram:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def close(self) -> None:
        """Unload the program."""
        self._runtime.close()

    def take(self, pieces: Pieces) -> None:
        """The segments, with the points at their ends, that questions are about."""
        rows = np.zeros(len(pieces), _SEGMENT)
        for row, (left, segment, right) in zip(rows, pieces, strict=True):
            ends = [getattr(point, name) for point in (left, right) for name in "xyvaj"]
            row["numbers"] = [*ends, segment.inflection]
            row["law"] = LAWS.index(segment.law)
        self._image.write(self._segments, rows.tobytes())

    def values(self, which: npt.NDArray[np.intp], x: Numbers) -> Numbers:
        """Position and three derivatives in rows, in numbered segments at positions of the master."""
        found = np.empty((len(x), 4))
        for start in range(0, len(x), QUESTIONS):
            part = slice(start, start + QUESTIONS)
            count = len(x[part])
            self._image.write(self._which, which[part].astype("<i2").tobytes())
            self._image.write(self._x, x[part].astype("<f8").tobytes())
            self._image.write(self._count, count.to_bytes(4, "little"))
            self._runtime.run(cycles=1)
            answer = self._image.read(self._values, 32 * count)
            found[part] = np.frombuffer(answer, "<f8").reshape(count, 4)
        return found


def _built(cache: Path | None) -> CodePackage:
    text = files("tappet.motion").joinpath("cam_program.st").read_text(encoding="utf-8")
    options = BuildOptions(libraries=(LibraryReference(LIBRARY),), cache=cache, once=True)
    task = Task("Task", interval_ns=1_000_000, programs=("Main",))
    result = build_application([Source("cam_program.st", text)], [task], options=options)
    if result.package is None:
        raise RuntimeError(str(next(d for d in result.diagnostics if d.severity == "error")))
    return result.package
