"""What is fuzzed: everything that reads text or bytes of a person or of another tool.

A target takes bytes and returns; anything it raises, other than what its contract names, is a find.
"""

from __future__ import annotations

import contextlib
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from random import Random

import byte_targets
import door_targets
import editor_targets
import gcode_target
from conversations import spoilt
from mutations import mutated, mutated_bytes, mutated_values

from tappet.codegen.build import BuildOptions, BuildSession, build_application
from tappet.lang.lexer import tokenize
from tappet.lang.parser import parse
from tappet.lang.source import Source
from tappet.project.exchange.importing import import_files
from tappet.project.exchange.report import ExchangeError

TESTS = Path(__file__).resolve().parents[1]
SAMPLES = TESTS / "project" / "exchange" / "samples"
SESSION = BuildSession()


def _text(data: bytes) -> str:
    return data.decode("utf-8", "replace")


def lexer(data: bytes) -> None:
    tokenize(Source("a.st", _text(data)))


def parser(data: bytes) -> None:
    text = _text(data)
    parse(Source("a.st", text))
    parse(Source("FB_A.Start", text, owner="FB_A"))


def checker(data: bytes) -> None:
    """Parser, analysis with all rules, lowering and generation; code is made by nobody."""
    options = BuildOptions(check_only=True)
    build_application([Source("a.st", _text(data))], (), options, session=SESSION)


def compiler(data: bytes) -> None:
    """As `checker`, with object code of what has no errors."""
    build_application([Source("a.st", _text(data))], (), BuildOptions(level=0), session=SESSION)


def il(data: bytes) -> None:
    """The bytes are the rows of a body."""
    head = "PROGRAM PLC_PRG\nVAR a, b : INT; x, y : BOOL; r : REAL; t1 : TON; s : STRING; END_VAR\nLD a\n"
    checker(head.encode() + data + b"\nEND_PROGRAM\n")


def _import(name: str, data: bytes) -> None:
    with contextlib.suppress(ExchangeError):
        import_files({name: data})


def plcopen(data: bytes) -> None:
    _import("a.xml", data)


def twincat(data: bytes) -> None:
    for ending in ("TcPOU", "TcDUT", "TcGVL", "TcTTO", "plcproj", "tsproj"):
        _import(f"a.{ending}", data)


def native(data: bytes) -> None:
    """CODESYS V3."""
    _import("a.export", data)


def export_file(data: bytes) -> None:
    """CoDeSys 2.3."""
    _import("a.EXP", data)


def plain_text(data: bytes) -> None:
    _import("a.st", data)


def _files(folder: Path, *endings: str) -> list[bytes]:
    found = [
        p for p in sorted(folder.rglob("*")) if p.suffix.lower() in endings and p.stat().st_size < 20_000
    ]
    return [p.read_bytes() for p in found]


def _programs() -> list[bytes]:
    return _files(TESTS / "conformance", ".st")


def _rows() -> list[bytes]:
    texts = [d.decode() for d in _files(TESTS / "conformance" / "il", ".st")]
    return [t.rpartition("END_VAR")[2].partition("END_PROGRAM")[0].encode() for t in texts]


@dataclass(frozen=True)
class Target:
    """What is fuzzed, what inputs are made of, and how they are changed."""

    run: Callable[[bytes], None]
    seeds: Callable[[], list[bytes]]
    mutate: Callable[[Random, list[bytes]], bytes] = mutated
    limit_s: int = 20
    """An input that takes longer is a find."""
    finish: Callable[[], None] = lambda: None
    """Behind the last input: what only shows then."""


TARGETS = {
    "lexer": Target(lexer, _programs),
    "parser": Target(parser, _programs),
    "checker": Target(checker, _programs),
    "compiler": Target(compiler, _programs),
    "il": Target(il, _rows),
    "plcopen": Target(plcopen, lambda: _files(SAMPLES, ".xml")),
    "twincat": Target(
        twincat, lambda: _files(SAMPLES, ".tcpou", ".tcdut", ".tcgvl", ".tctto", ".plcproj", ".tsproj")
    ),
    "native": Target(native, lambda: _files(SAMPLES, ".export")),
    "export": Target(export_file, lambda: _files(SAMPLES, ".exp") or _programs()),
    "text": Target(plain_text, _programs),
    "folder": Target(byte_targets.folder, byte_targets.folders),
    "archive": Target(byte_targets.archive, byte_targets.archives, mutated_bytes),
    "library": Target(byte_targets.library_file, byte_targets.library_files, mutated_bytes),
    "flight": Target(byte_targets.flight, byte_targets.flights, mutated_values),
    "package": Target(byte_targets.package, byte_targets.packages, mutated_values),
    "frame": Target(byte_targets.frame, byte_targets.frames, mutated_values),
    "literal": Target(byte_targets.literal, byte_targets.literals),
    "gcode": Target(gcode_target.gcode, gcode_target.seeds, gcode_target.mutate),
    "editor": Target(editor_targets.editor, _programs),
    "messages": Target(editor_targets.messages, editor_targets.conversations),
    **{
        name: Target(run, door_targets.DOORS[name][1], spoilt, 300, partial(door_targets.finish, name))
        for name, run in door_targets.TALKS.items()
    },
}
