"""Compiler processes: shared results, cancelling, and what happens when one dies."""

from __future__ import annotations

import asyncio
import sys
from pathlib import Path
from typing import Any

import pytest
from unread_answers import ends_quietly

from tappet.codegen.generate import Generator
from tappet.iec.places import Segment, SourceMap
from tappet.iec.source import Source
from tappet.server.builds.builder import WORKER, Application, Builder
from tappet.server.builds.packages import KEEP, PackageStore
from tappet.server.builds.worker import Compiler
from tappet.server.frames import CANCEL, pack_frame
from tappet.server.problems import Problem

FAKE = (sys.executable, str(Path(__file__).with_name("fake_compiler.py")))


def application(text: str, id: str = "a") -> Application:
    segments = (Segment(0, "o", "declaration"),)
    source = Source("PLC_PRG", text, map=SourceMap(segments))
    return Application("p", id, "Application", (source,), (), (), {"o": "PLC_PRG", id: "Application"})


@pytest.fixture
async def builder(tmp_path: Path):
    builder = Builder(1, tmp_path, FAKE)
    yield builder
    await builder.close()


async def test_equal_texts_are_built_once(builder: Builder) -> None:
    first, second = await asyncio.gather(*(builder.build(application("x"), None) for _ in range(2)))
    third = await builder.build(application("x"), None)
    assert first.report.code_id == second.report.code_id == third.report.code_id == "1"
    assert (await builder.build(application("y"), None)).report.code_id == "2"
    assert (await builder.build(application("y"), ("base", b""))).report.code_id == "3"


async def appearing(path: Path) -> None:
    """Waits until the compiler process has made a file."""
    async with asyncio.timeout(60):
        while not path.exists():  # noqa: ASYNC110, ASYNC240 - another process makes it
            await asyncio.sleep(0.01)


async def test_a_cancelled_build_ends_at_once_and_the_next_works(builder: Builder, tmp_path: Path) -> None:
    waiting = asyncio.create_task(builder.build(application(f"sleep {tmp_path / 'begun'}"), None))
    await appearing(tmp_path / "begun")
    assert builder.cancel("p", "a")
    with pytest.raises(Problem) as caught:
        await asyncio.wait_for(waiting, 60)
    assert caught.value.kind == "build-cancelled"
    assert (await builder.build(application("x"), None)).report.ok
    assert not builder.cancel("p", "a")


async def test_a_compiler_that_obeys_a_cancellation_lives_on(builder: Builder, tmp_path: Path) -> None:
    assert (await builder.build(application("x"), None)).report.code_id == "1"
    waiting = asyncio.create_task(builder.build(application(f"patient {tmp_path / 'begun'}"), None))
    await appearing(tmp_path / "begun")
    assert builder.cancel("p", "a")
    with pytest.raises(Problem, match="cancelled"):
        await asyncio.wait_for(waiting, 60)
    assert (await builder.build(application("y"), None)).report.code_id == "3", "the same process has counted"


def compile_order(body: str) -> dict[str, Any]:
    source = {"uri": "PLC_PRG", "text": f"PROGRAM PLC_PRG\nVAR a : INT; END_VAR\n{body}\nEND_PROGRAM"}
    source |= {"scope": "application"}
    return {
        "key": "p/a", "application": "A", "project": "P", "sources": [source], "tasks": [],
        "libraries": [], "previous": None, "cache": "",
        "static": {"rules": {}, "prefixes": {}, "limits": {}}, "check_only": False, "instrumented": False,
        "fresh": False,
        "disabled_warnings": (),
        "heap": {"limit": 1 << 16, "poison": False}, "reserve": {"percent": 100, "least": 1 << 16},
    }  # fmt: skip


def test_a_cancelled_build_leaves_the_session(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    compiler = Compiler()
    first = compiler.outcome(compile_order("a := 1;") | {"cache": str(tmp_path)})
    assert first["package"]
    with monkeypatch.context() as patch:
        patch.setattr(Generator, "again", lambda *_: compiler.cancel(CANCEL, None))
        cancelled = compiler.outcome(compile_order("a := 2;") | {"cache": str(tmp_path)})
    assert cancelled == {"cancelled": True}
    compiler.cancel(CANCEL, None)  # too late: nothing is being built
    after = compiler.outcome(compile_order("a := 3;") | {"cache": str(tmp_path)})
    assert after["package"]
    assert "layout" in after["timings"]
    again = compiler.outcome(compile_order("a := 4;") | {"cache": str(tmp_path)})
    assert "layout" not in again["timings"]
    assert len({first["code_id"], after["code_id"], again["code_id"]}) == 3


def test_a_compiler_without_its_server_ends_quietly(tmp_path: Path) -> None:
    ends_quietly(WORKER, pack_frame(compile_order("a := 1;") | {"cache": str(tmp_path)}))


def test_an_online_change_takes_the_short_way(tmp_path: Path) -> None:
    compiler = Compiler()
    old = compiler.outcome(compile_order("a := 1;") | {"cache": str(tmp_path)})
    new = compiler.outcome(compile_order("a := 2;") | {"cache": str(tmp_path), "previous": old["package"]})
    assert "layout" not in new["timings"]
    assert (new["change_base"], new["data_id"]) == (old["code_id"], old["data_id"])


async def test_who_only_waits_may_leave(builder: Builder) -> None:
    """A browser that closes must not end the build that another waits for."""
    first = asyncio.create_task(builder.build(application("x"), None))
    second = asyncio.create_task(builder.build(application("x"), None))
    await asyncio.sleep(0)  # both have begun to wait
    first.cancel()
    assert (await second).report.ok


@pytest.mark.parametrize(("text", "words"), [("die", "its process ended"), ("fail", "KeyError")])
async def test_a_dead_compiler_is_a_problem_and_is_replaced(builder: Builder, text: str, words: str) -> None:
    with pytest.raises(Problem, match=words):
        await builder.build(application(text), None)
    assert (await builder.build(application("x"), None)).report.ok


def test_package_store_keeps_the_newest(tmp_path: Path) -> None:
    store = PackageStore(tmp_path)
    assert store.find("c1") is None
    assert store.latest("p", "a") is None
    for n in range(KEEP + 3):
        store.put("p", "a", f"c{n}", b"no package")
    assert len(list(tmp_path.glob("*.package"))) == KEEP
    assert store.find(f"c{KEEP}") is None, "what is no package is not offered"
    assert store.find("../../etc/passwd") is None
    with pytest.raises(ValueError, match="no id"):
        store.put("../p", "a", "c", b"")


async def test_a_cleaned_application_is_built_anew_once(builder: Builder) -> None:
    await builder.build(application("x"), None)
    builder.clean("p", "a")
    builder.clean("p", "never built")
    assert (await builder.build(application("x"), None)).report.code_id == "2"
    assert (await builder.build(application("x"), None)).report.code_id == "2"
    assert (await builder.build(application("x"), None, fresh=True)).report.code_id == "3"
    assert (await builder.build(application("x"), None)).report.code_id == "3"


def test_a_fresh_build_uses_nothing_of_earlier_ones(tmp_path: Path) -> None:
    compiler = Compiler()
    order = compile_order("a := a + 1;") | {"cache": str(tmp_path)}
    assert compiler.build(order)["package"]
    kept = set(tmp_path.rglob("*"))
    session = compiler._sessions[order["key"]]
    assert compiler.build(order)["package"]
    assert compiler._sessions[order["key"]] is session
    assert compiler.build(order | {"fresh": True})["package"]
    assert compiler._sessions[order["key"]] is not session
    assert set(tmp_path.rglob("*")) == kept
    assert compiler.build(order)["package"]
