"""Runs decoder, preprocessing, velocity check and interpolator of SM3_CNC on a program, on virtual time.

What is shown and what is compiled is made by the blocks that run on the controller. A program is built once
for each chain of blocks, in some seconds, with a folder of compiled objects much faster.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import numpy.typing as npt

from tappet.cnc.letters import END_OF_PROGRAM
from tappet.cnc.queue_file import FIELDS
from tappet.cnc.word_list import WORD_SIZE, CodeWord, packed
from tappet.codegen.build import BuildOptions, LibraryReference, build_application
from tappet.codegen.package import CodePackage
from tappet.iec.task import Task
from tappet.lang.source import Source
from tappet.motion.path_blocks import LIBRARY, PathBlock
from tappet.motion.path_program_text import RING, SAMPLE_FIELDS, program_text
from tappet.runtime.flight import FlightSettings
from tappet.runtime.local import LocalRuntime

Rows = npt.NDArray[np.void]
Samples = npt.NDArray[np.float64]
MOST_IDLE = 100
"""Cycles without an object after which a program is one that goes round for ever."""
_NUMPY = {
    "bool": {1: "u1"},
    "int": {1: "i1", 2: "<i2", 4: "<i4", 8: "<i8"},
    "uint": {1: "u1", 2: "<u2", 4: "<u4", 8: "<u8"},
    "bits": {1: "u1", 2: "<u2", 4: "<u4", 8: "<u8"},
    "enum": {2: "<i2", 4: "<i4"},
    "real": {4: "<f4", 8: "<f8"},
}


WHOLE = 0xFFFFFFFF
"""udiBuffer of a program that is whole in memory."""
NOBODY, DECODER, VELOCITY_CHECK, INTERPOLATOR = -1, 0, -2, -3
"""Who failed; the blocks of the chain have numbers from 1."""


@dataclass(frozen=True, slots=True)
class ProgramFault:
    """What stopped a block."""

    who: int
    code: str
    """Value of SMC_ERROR."""
    text: str
    """What SMC_ErrorString says of it, in English."""
    line: int
    """Of the program, from 1; 0 where it is about none."""
    word: str
    """At fault, as the decoder writes it; empty where it is the line."""


class EndlessProgramError(ValueError):
    """The program jumps back for ever without a movement."""


class PathProgram:
    """The program of one chain of blocks; takes one CNC program after the other. Not for several threads."""

    def __init__(self, blocks: Sequence[PathBlock], queue: int, cache: Path | None = None) -> None:
        """`queue`: objects of the queues in the chain; `cache`: a folder of compiled objects."""
        self.blocks = tuple(blocks)
        self._runtime = LocalRuntime(
            _built(program_text(blocks, queue), cache), flight=FlightSettings(memory=0)
        )
        application = self._runtime.plc.application
        assert application is not None
        self._image = application.image
        self._words = self._offset("aWords")
        if self._size("aWords") != RING * WORD_SIZE:
            raise RuntimeError("SMC_GCODE_WORD of SM3_CNC is laid out in another way")
        self.geo = self._geo()
        self._taken = self._offset("aTaken")
        self._samples = self._offset("afSamples")
        self._runtime.run(cycles=1)
        self.variables = int(self._read("pVariables"))
        """Address of the first variable that words may refer to; each is an LREAL."""
        self.parameters = int(self._read("pParameters"))
        """Address of parameters of M functions, all 0."""
        self._all = b""
        self._count = 0
        """Words of the program."""
        self._fed = 0

    def close(self) -> None:
        """Unload the program."""
        self._runtime.close()

    def start(
        self,
        words: bytes,
        variables: Samples,
        start: Sequence[float],
        *,
        suppress: bool,
        parameters: Sequence[tuple[str, str]] = (),
        interpolation_us: int = 0,
    ) -> None:
        """Begin with a program. `words`: packed SMC_GCODE_WORDs; `start`: the position, eleven axes;
        `parameters`: inputs of blocks such as `0.dRadius` with literals, which raise ValueError where they do
        not fit; `interpolation_us`: the positions of each such cycle are wanted, not the objects."""
        self._runtime.reset("cold")
        self._runtime.start()
        self._image.write(self._offset("afVariables"), variables.astype("<f8").tobytes())
        self._write("xStepSuppress", suppress)
        for axis, value in zip(_AXES, start, strict=True):
            self._write(f"prog.piStartPosition.{axis}", float(value))
        for name, literal in parameters:
            self._runtime.write(f"Main.fb{name}", literal)
        self._write("dwIpoTime", interpolation_us)
        self._write("xInterpolates", interpolation_us > 0)
        self._all, self._count, self._fed = words, len(words) // WORD_SIZE, 0
        if self._count <= RING:
            self._image.write(self._words, words)
            self._write("prog.nElements", self._count)
            self._write("prog.udiBuffer", WHOLE)
        else:
            self._all += packed([CodeWord(END_OF_PROGRAM)], lambda word: (0, 0))
            self._count += 1
            self._write("prog.nElements", 0)
            self._write("prog.udiBuffer", RING)
        self._runtime.run(cycles=1)
        self._write("xExecute", True)

    def objects(self) -> Iterator[Rows]:
        """The objects of the path, with the fields of `geo`, in parts. Raises EndlessProgramError."""
        for _ in self._cycles():
            count = int(self._read("diTaken"))
            data = self._image.read(self._taken, count * self.geo.itemsize)
            yield np.frombuffer(data, self.geo)

    def samples(self) -> Iterator[Samples]:
        """Rows of SAMPLE_FIELDS, in parts. Raises EndlessProgramError."""
        width = len(SAMPLE_FIELDS)
        for _ in self._cycles():
            count = int(self._read("diSamples"))
            data = self._image.read(self._samples, count * 8 * width)
            yield np.frombuffer(data, "<f8").reshape(count, width)

    @property
    def fault(self) -> ProgramFault | None:
        """What went wrong; None: nothing did."""
        who = int(self._read("iFault"))
        if who == NOBODY:
            return None
        return ProgramFault(
            who,
            self._text("eFault").rpartition(".")[2],
            self._text("sFault"),
            int(self._read("diFaultLine")),
            self._text("fbDecoder.sErrorWord") if who == DECODER else "",
        )

    def _cycles(self) -> Iterator[None]:
        """Runs cycles until the path is over; each may have given something."""
        idle = 0
        while True:
            self._feed()
            self._runtime.run(cycles=1)
            given = int(self._read("diTaken")) + int(self._read("diSamples"))
            idle = 0 if given else idle + 1
            if given:
                yield None
            who = int(self._read("iFault"))
            if self._read("xEnded") or who not in (NOBODY, DECODER):
                return
            if idle > MOST_IDLE:
                raise EndlessProgramError

    def _feed(self) -> None:
        """Fills the ring of a long program; begins again after a jump."""
        if self._count <= RING:
            return
        if self._read("prog.bRestart"):
            self._fed = 0
            for name in ("nElements", "diReadPos"):
                self._write(f"prog.{name}", 0)
            self._write("prog.bRestart", False)
        read = int(self._read("prog.diReadPos"))
        free = min(RING - (self._fed - read), self._count - self._fed)
        while free > 0:
            place = self._fed % RING
            count = min(free, RING - place)
            part = self._all[self._fed * WORD_SIZE : (self._fed + count) * WORD_SIZE]
            self._image.write(self._words + place * WORD_SIZE, part)
            self._fed += count
            free -= count
        self._write("prog.nElements", self._fed)

    def _offset(self, name: str) -> int:
        return self._runtime.package.symbols.resolve(f"Main.{name}").offset

    def _size(self, name: str) -> int:
        return self._runtime.package.symbols.resolve(f"Main.{name}").size

    def _read(self, name: str) -> int:
        value = self._runtime.read(f"Main.{name}")
        assert isinstance(value, int)
        return value

    def _text(self, name: str) -> str:
        return self._runtime.literal(f"Main.{name}").strip("'")

    def _write(self, name: str, value: float) -> None:
        self._runtime.write(f"Main.{name}", value)

    def _geo(self) -> np.dtype[np.void]:
        """Layout of SMC_GEOINFO as it was compiled: its numbers by the names of a queue file."""
        resolve = self._runtime.package.symbols.resolve
        first = resolve("Main.aTaken[0]")
        refs = {field: resolve(f"Main.aTaken[0].{field}") for field in FIELDS}
        return np.dtype(
            {
                "names": list(refs),
                "formats": [_NUMPY[ref.type.kind][ref.size] for ref in refs.values()],
                "offsets": [ref.offset - first.offset for ref in refs.values()],
                "itemsize": first.size,
            }
        )


_AXES = ("dX", "dY", "dZ", "dA", "dB", "dC", "dA1", "dA2", "dA3", "dA4", "dA5")


def _built(text: str, cache: Path | None) -> CodePackage:
    options = BuildOptions(
        libraries=(LibraryReference(LIBRARY), LibraryReference("SM3_Basic")), cache=cache, once=True
    )
    task = Task("Task", interval_ns=1_000_000, programs=("Main",))
    result = build_application([Source("path_program.st", text)], [task], options=options)
    if result.package is None:
        raise RuntimeError(str(next(d for d in result.diagnostics if d.severity == "error")))
    return result.package
