"""Blocks with generic constants over edits: a session builds what a build of all texts gives, values stay."""

from __future__ import annotations

from plc_programs import MAIN

from tappet.codegen.build import BuildOptions, BuildSession, build_application
from tappet.codegen.package import CodePackage
from tappet.lang.source import Source
from tappet.runtime.local import LocalRuntime

RING = """FUNCTION_BLOCK FB_Ring
VAR_GENERIC CONSTANT size : INT; END_VAR
VAR_OUTPUT count, room : INT; END_VAR
VAR buffer : ARRAY[1..size] OF INT; END_VAR
count := count + {step};
Push();
END_FUNCTION_BLOCK"""
PUSH = "METHOD Push\nroom := size + {more};\nEND_METHOD"
MAIN_TEXT = """PROGRAM PLC_PRG
VAR one : FB_Ring<{one}>; other : FB_Ring<(2 * G.wide)>; END_VAR
one();
other();
END_PROGRAM"""


def sources(step: int = 1, more: int = 0, one: int = 20, wide: int = 5) -> list[Source]:
    return [
        Source("FB_Ring", RING.format(step=step)),
        Source("FB_Ring.Push", PUSH.format(more=more), owner="FB_Ring"),
        Source("PLC_PRG", MAIN_TEXT.format(one=one)),
        Source("G", f"VAR_GLOBAL CONSTANT wide : INT := {wide}; END_VAR", name="G"),
    ]


def built(session: BuildSession, texts: list[Source], previous: CodePackage | None = None) -> CodePackage:
    result = build_application(texts, MAIN, BuildOptions(level=1), previous=previous, session=session)
    assert result.package is not None, [str(d) for d in result.diagnostics]
    plain = build_application(texts, MAIN, BuildOptions(level=1), previous=previous)
    assert plain.package is not None
    assert plain.package.code_id == result.package.code_id
    return result.package


def test_edits_of_the_block_its_methods_and_its_values() -> None:
    session = BuildSession()
    paths = ("one.count", "one.room", "other.count", "other.room")
    with LocalRuntime(built(session, sources())) as runtime:

        def after(**changes: int) -> list[object]:
            texts = sources(**changes)
            package = built(session, texts, runtime.package)
            runtime.plc.download(package.to_bytes(), "online_change")
            runtime.run(cycles=1)
            return [runtime.read(f"PLC_PRG.{path}") for path in paths]

        runtime.run(cycles=1)
        assert [runtime.read(f"PLC_PRG.{path}") for path in paths] == [1, 20, 1, 10]
        assert after(step=10) == [11, 20, 11, 10]
        assert after(step=10, more=3) == [21, 23, 21, 13]
        assert after(step=10, more=3, one=30) == [31, 33, 31, 13]
        assert after(step=10, more=3, one=30, wide=6) == [41, 33, 41, 15]
