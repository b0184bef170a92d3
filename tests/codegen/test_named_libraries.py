"""Builds without the library texts that a program cannot reach are the same as builds with all of them."""

from __future__ import annotations

import multiprocessing
import os
from collections.abc import Sequence
from pathlib import Path
from random import Random

import pytest
from sampled import sampled
from tests.spec.language_cases import load_cases, sources_of

from tappet.bench.large_library import install
from tappet.codegen import compile_pool
from tappet.codegen.build import BuildOptions, BuildResult, build_application
from tappet.lang.analysis import AnalysisOptions, analyse
from tappet.lang.analysis.libraries import read_program
from tappet.lang.source import Scope, Source
from tappet.libraries import named, names, repository, resolve
from tappet.libraries.named import index_of, named_texts
from tappet.project.library_reference import LibraryReference

CONFORMANCE = sorted((Path(__file__).parents[1] / "conformance").rglob("*.st"))
CASES = load_cases()
CHOSEN = Random(9).sample(range(len(CASES)), 60)
REFERENCES = tuple(LibraryReference(name) for name in ("Standard", "Standard64", "Util", "Tc2_System"))
MOTION = (*REFERENCES, LibraryReference("MotionLike"))


class _NoMachineCode:
    """Stands in for LLVM: keeps the texts that it would get."""

    def __init__(self, *given: object) -> None:
        self.texts: list[str] = []

    def add(self, text: str) -> str:
        self.texts.append(text)
        return str(len(self.texts))

    def objects(self) -> list[bytes]:
        return [text.encode() for text in self.texts]


@pytest.fixture(autouse=True)
def own_cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    monkeypatch.setattr(named, "_kept", type(named._kept)())
    return tmp_path / "cache" / "tappet" / "libraries"


@pytest.fixture
def motion(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(repository.LOCATION_VARIABLE, str(tmp_path / "installed"))
    install(tmp_path / "installed", blocks=12, lines=600)


def outcome(result: BuildResult) -> object:
    messages = sorted(str(d) for d in result.diagnostics)
    return messages, result.package.to_bytes() if result.package is not None else None


def compare(sources: Sequence[Source], references: tuple[LibraryReference, ...] = REFERENCES) -> None:
    options = BuildOptions(libraries=references, free_addresses=False)
    once = BuildOptions(libraries=references, free_addresses=False, once=True)
    assert outcome(build_application(sources, options=once)) == outcome(
        build_application(sources, options=options)
    )


def library_texts(references: Sequence[LibraryReference]) -> list[Source]:
    return [source for library in resolve(references)[0] for source in library.sources]


@pytest.mark.parametrize("path", sampled(CONFORMANCE, 3), ids=lambda path: path.stem)
def test_conformance_programs(path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(compile_pool, "Compilation", lambda *given, **options: _NoMachineCode())
    compare([Source(path.name, path.read_text(encoding="utf-8"))])


@pytest.mark.parametrize("number", sampled(CHOSEN, 3))
def test_language_examples(number: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(compile_pool, "Compilation", lambda *given, **options: _NoMachineCode())
    compare(sources_of(CASES[number]))


@pytest.mark.parametrize(
    "body",
    [
        "VAR ax : MX_AXIS_REF; m : MX_Move6; END_VAR\nm(Axis := ax, bExecute := TRUE, fTarget6 := 5);",
        "VAR e : MotionLike.MX_State; a : MX_IAxis; b : MX_Base; END_VAR\ne := MX_State.Stopping; a := b;",
        "VAR x : ARRAY[0..MX_cSegments] OF INT; s : STRING; END_VAR\ns := TO_STRING(x[1]) ;",
        "VAR k : INT; t : R_TRIG; END_VAR\nk := MX_Cruise; t(CLK := TRUE); k := TO_INT('12');",
        "VAR m : MX_Mov6; END_VAR\nm(); MX_Clam(1); x := MotionLike.Nothing;",
    ],
    ids=["block", "types", "constant", "value", "misspelt"],
)
@pytest.mark.usefixtures("motion")
def test_programs_on_a_library_like_a_motion_library(body: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(compile_pool, "Compilation", lambda *given, **options: _NoMachineCode())
    compare([Source("Main", f"PROGRAM Main\n{body}\nEND_PROGRAM")], MOTION)


@pytest.mark.usefixtures("motion")
def test_what_is_taken() -> None:
    libraries = library_texts(MOTION)
    program = Source("Main", "PROGRAM Main\nVAR m : MX_Move6; END_VAR\nEND_PROGRAM")
    taken = {source.name for source in named_texts(libraries, [program])}
    assert {"MX_Move6", "MX_Move5", "MX_Base", "MX_IAxis", "MX_AXIS_REF", "MX_Segment", "TON"} <= taken
    assert not taken & {"MX_Move0", "MX_Move11", "TOF", "CTU", "BLINK"}
    assert {"MX_Limits", "Constants"} <= {s.name for s in named_texts(libraries, [])}, "data are always there"


def test_nothing_is_left_out_of_a_library_with_messages() -> None:
    wrong = Source(
        "L/F", "FUNCTION F : INT\nF := nowhere;\nEND_FUNCTION", Scope.LIBRARY, library="L", namespace="L"
    )
    other = Source(
        "L/G", "FUNCTION G : INT\nG := 1;\nEND_FUNCTION", Scope.LIBRARY, library="L", namespace="L"
    )
    assert named_texts([wrong, other], []) == [wrong, other]
    assert named_texts([other], []) == []


# -- the cache --------------------------------------------------------------------------------------


def stored(folder: Path) -> list[Path]:
    return sorted(folder.iterdir())


def forget(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(named, "_kept", type(named._kept)())


def no_analysis(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(libraries: object) -> None:
        raise AssertionError("the index is made again")

    monkeypatch.setattr(named, "_made", refuse)


def test_the_index_is_made_once(own_cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    libraries = library_texts(REFERENCES)
    made = index_of(libraries)
    assert len(stored(own_cache)) == 1
    forget(monkeypatch)
    no_analysis(monkeypatch)
    assert index_of(libraries) == made


@pytest.mark.parametrize(
    "damage",
    [lambda d: b"", lambda d: d[:-1], lambda d: bytes([d[0] ^ 1]) + d[1:], lambda d: b"x" * 99],
    ids=["empty", "cut", "check sum", "foreign"],
)
def test_a_damaged_index_is_made_again(damage, own_cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    libraries = library_texts(REFERENCES)
    made = index_of(libraries)
    (file,) = stored(own_cache)
    whole = file.read_bytes()
    file.write_bytes(damage(whole))
    forget(monkeypatch)
    assert index_of(libraries) == made
    assert file.read_bytes() == whole


def test_an_index_of_another_compiler_or_other_texts_is_not_taken(
    own_cache: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    libraries = library_texts(REFERENCES)
    index_of(libraries)
    forget(monkeypatch)
    monkeypatch.setattr(named, "compiler_stamp", lambda: "another")
    index_of(libraries)
    assert len(stored(own_cache)) == 2
    index_of(libraries[:-1])
    assert len(stored(own_cache)) == 3
    (first, *_) = stored(own_cache)
    assert named.Index.from_bytes(first.read_bytes(), 1) is None, "as many texts as it was made of"


def test_a_folder_that_others_may_write_is_not_used(own_cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    own_cache.mkdir(parents=True)
    own_cache.chmod(0o777)
    libraries = library_texts(REFERENCES)
    assert named_texts(libraries, [])
    assert stored(own_cache) == []


def test_a_folder_that_cannot_be_written_is_no_error(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    blocked = tmp_path / "blocked"
    blocked.write_text("a file where the folder should be")
    monkeypatch.setenv("XDG_CACHE_HOME", str(blocked))
    assert named_texts(library_texts(REFERENCES), [])


def _write(number: int) -> bool:
    libraries = library_texts(REFERENCES)
    return index_of(libraries).everything


def test_processes_that_write_at_once_leave_one_sound_index(own_cache: Path) -> None:
    with multiprocessing.get_context("spawn").Pool(3) as pool:
        assert pool.map(_write, range(3)) == [False] * 3
    (file,) = stored(own_cache)
    assert named.Index.from_bytes(file.read_bytes(), len(library_texts(REFERENCES))) is not None
    assert os.stat(file).st_mode & 0o077 == 0


def test_no_library_of_the_product_has_messages_that_keep_all_of_it() -> None:
    found, problems = resolve([LibraryReference(name) for name in names()])
    assert not problems
    sources = [source for library in found for source in library.sources]
    results, shared = read_program(sources, AnalysisOptions())
    assert shared is not None
    messages = [d for result in results for d in result.diagnostics]
    messages += analyse([], libraries=shared).diagnostics
    assert [str(message) for message in messages] == []
    assert not index_of(sources).everything


def test_a_library_text_that_converts_brings_the_functions_behind_the_operators() -> None:
    references = (LibraryReference("Standard"), LibraryReference("TappetUnit"))
    texts = library_texts((*references, LibraryReference("Conversion")))
    suite = Source("Suite.st", "FUNCTION_BLOCK Suite EXTENDS FB_TestSuite\nEND_FUNCTION_BLOCK")
    taken = named_texts(texts, [suite])
    assert {source.uri for source in texts if source.library == "Conversion"} < {s.uri for s in taken}
    assert len(taken) < len(texts)
