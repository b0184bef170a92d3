"""Several sessions on one project: one analysis, and places in the lines that each of them shows."""

from __future__ import annotations

import asyncio
import random
from collections.abc import AsyncIterator, Mapping
from contextlib import asynccontextmanager
from typing import Any

import pytest
from lsp_client import Client, FakeProject, uri
from lsp_project import BODY, HEAD, PROJECT, here

from tappet.lang.services.documents import Program
from tappet.server.lsp.project_analysis import ProjectAnalysis
from tappet.server.lsp.shared_texts import SharedTexts
from tappet.server.lsp.text_difference import TextDifference

MOTOR = uri("FB_Motor", "declaration")


class Stored(FakeProject):
    """A project whose stored texts the sessions can be compared with."""

    def stored(self, document: str) -> str | None:
        name, part = document.split("/")[-2:]
        texts = self.objects.get(name)
        return texts[part == "implementation"] if texts is not None else None


class Counted(Stored):
    """Counts how often it is composed."""

    composed = 0

    def __call__(self, unsaved: Mapping[str, str]) -> list[Program]:
        self.composed += 1
        return super().__call__(unsaved)


@asynccontextmanager
async def clients(number: int, project: Stored) -> AsyncIterator[list[Client]]:
    """Initialized clients of one analysis."""
    analysis = ProjectAnalysis(project, stored=project.stored, debounce_s=0.0)
    made = [Client(analysis=analysis) for _ in range(number)]
    try:
        for client in made:
            await client.start()
        yield made
    finally:
        for client in made:
            await client.session.close()
        await analysis.close()


def codes(diagnostics: list[dict[str, Any]]) -> list[str]:
    return [d["code"] for d in diagnostics]


async def until_published(
    client: Client, document: str, expected: list[str], line: int | None = None
) -> list[dict[str, Any]]:
    """Wait until a client gets just these errors, the first one in a line."""
    while True:
        found = [d for d in await client.published(document) if d["severity"] == 1]
        if codes(found) == expected and (line is None or found[0]["range"]["start"]["line"] == line):
            return found


async def change(client: Client, document: str, text: str, version: int) -> None:
    await client.notify(
        "textDocument/didChange",
        {"textDocument": {"uri": document, "version": version}, "contentChanges": [{"text": text}]},
    )


async def test_users_see_each_others_declarations_at_once() -> None:
    async with clients(2, Stored(**PROJECT)) as (one, two):
        body = "iCount := iCount + iStep;\n"
        await two.open(BODY, body)
        await until_published(two, BODY, ["E0201"])
        declaration = PROJECT["PLC_PRG"][0].replace("iCount : INT;", "iCount, iStep : INT;")
        await one.open(HEAD, PROJECT["PLC_PRG"][0])
        await change(one, HEAD, declaration, 2)
        await until_published(two, BODY, [])
        found = await two.ask(
            "textDocument/definition",
            {"textDocument": {"uri": BODY}, "position": {"line": 0, "character": body.index("iStep") + 1}},
        )
        assert found is None  # the line that declares it is in no text that this user is shown
        await one.session.close()
        await until_published(two, BODY, ["E0201"])


async def test_ten_sessions_are_one_analysis() -> None:
    project = Counted(**PROJECT)
    async with clients(10, project) as all_clients:
        for client in all_clients:
            await client.open(BODY, PROJECT["PLC_PRG"][1])
            assert await client.published(BODY) == []
        composed = project.composed
        assert composed == 1
        await change(all_clients[0], BODY, "iCount := iMissing;", 2)
        for client in all_clients[:1]:
            await until_published(client, BODY, ["E0201"])
        await asyncio.gather(*(client.session.endpoint.settle() for client in all_clients))
        assert project.composed == composed + 1
        assert all_clients[0].session.workspace is all_clients[9].session.workspace


async def test_each_session_has_its_own_language() -> None:
    async with clients(1, Stored(**PROJECT)) as (english,):
        chinese = Client(analysis=english.analysis)
        await chinese.start("zh-CN")
        text = "iCount := iMissing;"
        await english.open(BODY, text)
        await chinese.open(BODY, text)
        (first,), (second,) = (
            await until_published(english, BODY, ["E0201"]),
            await until_published(chinese, BODY, ["E0201"]),
        )
        assert first["message"] != second["message"]
        assert first["range"] == second["range"]
        await chinese.session.close()


async def test_two_texts_of_one_document_have_their_own_positions() -> None:
    stored = "iCount := 1;\niCount := 2;\niCount := iMissing;\n"
    project = Stored(**{**PROJECT, "PLC_PRG": (PROJECT["PLC_PRG"][0], stored)})
    async with clients(2, project) as (one, two):
        await one.open(BODY, stored)
        await two.open(BODY, stored)
        for client in (one, two):
            await until_published(client, BODY, ["E0201"], line=2)
        await change(one, BODY, "(* new *)\n" + stored, 2)
        await until_published(one, BODY, ["E0201"], line=3)
        await until_published(two, BODY, ["E0201"], line=2)

        def at(line: int) -> dict[str, Any]:
            return {"textDocument": {"uri": BODY}, "position": {"line": line, "character": 2}}

        assert (await two.ask("textDocument/hover", at(1)))["range"] == here(1, 0, 6)
        assert (await one.ask("textDocument/hover", at(2)))["range"] == here(2, 0, 6)
        found = await two.ask("textDocument/documentHighlight", at(0))
        assert [place["range"]["start"]["line"] for place in found] == [0, 1, 2]
        # the line that only the second user has is no part of the analysed text: no answer, and no wrong one
        await change(two, BODY, stored.replace("2;", "3;"), 2)
        await until_published(two, BODY, ["E0201"])
        assert await one.ask("textDocument/hover", at(2)) is None
        refused = await one.refused("textDocument/rename", {**at(2), "newName": "iOther"})
        assert "Somebody else" in refused["message"]
        assert (await two.ask("textDocument/hover", at(1)))["range"] == here(1, 0, 6)
        # the newest edit is closed: the other one's counts again
        await two.notify("textDocument/didClose", {"textDocument": {"uri": BODY}})
        await until_published(one, BODY, ["E0201"], line=3)
        assert (await one.ask("textDocument/hover", at(2)))["range"] == here(2, 0, 6)


async def test_opening_the_stored_text_hides_no_edit() -> None:
    project = Stored(**PROJECT)
    async with clients(2, project) as (one, two):
        await one.open(BODY, PROJECT["PLC_PRG"][1])
        await change(one, BODY, "iCount := iMissing;", 2)
        await until_published(one, BODY, ["E0201"])
        await two.open(BODY, PROJECT["PLC_PRG"][1])
        assert await two.published(BODY) == []  # the mistake is in a line that is not shown here
        await one.notify("workspace/didChangeWatchedFiles", {"changes": []})
        symbols = await one.ask(
            "textDocument/hover", {"textDocument": {"uri": BODY}, "position": here(0, 2, 2)["start"]}
        )
        assert symbols["range"] == here(0, 0, 6)
        assert one.analysis.texts.analysed(BODY) == "iCount := iMissing;"


def test_the_newest_edit_counts_and_no_opening() -> None:
    texts = SharedTexts({"a": "stored"}.get)
    texts.put("one", "a", "first")
    texts.put("two", "a", "stored")
    assert texts.taken("a") == "first"
    texts.put("two", "a", "second")
    assert texts.taken("a") == "second"
    texts.drop("two", "a")
    assert texts.taken("a") == "first"
    texts.put("one", "a", "stored")
    assert texts.taken("a") is None
    assert texts.analysed("a") == "stored"
    texts.drop("one", "a")
    texts.drop("nobody", "a")
    assert texts.analysed("b") is None


@pytest.mark.parametrize("seed", range(20))
def test_lines_of_a_difference_are_the_same_lines(seed: int) -> None:
    rng = random.Random(seed)
    words = ["a", "b", "c", "", "d e"]
    here_lines = [rng.choice(words) for _ in range(rng.randrange(30))]
    there_lines = list(here_lines)
    for _ in range(rng.randrange(6)):
        at = rng.randrange(len(there_lines) + 1)
        there_lines[at : at + rng.randrange(3)] = [rng.choice(words) for _ in range(rng.randrange(3))]
    found = TextDifference("\n".join(here_lines), "\n".join(there_lines))
    here_lines, there_lines = here_lines or [""], there_lines or [""]
    mapped = [found.to_there(line) for line in range(len(here_lines))]
    for line, other in enumerate(mapped):
        if other is not None:
            assert there_lines[other] == here_lines[line]
            assert found.to_here(other) == line
    kept = [other for other in mapped if other is not None]
    assert kept == sorted(set(kept))
    assert found.to_there(len(here_lines) + 5) is None
    if here_lines == there_lines:
        assert mapped == list(range(len(here_lines)))


WORDS = (
    "iCount",
    "motor.xOn",
    "iMissing",
    "1",
    ":=",
    ";",
    "\n",
    "IF ",
    " THEN ",
    "END_IF;",
    "iStep",
    "\U0001f600",
    "(* x *)",
)


@pytest.mark.parametrize("seed", range(6))
async def test_random_edits_of_several_sessions_are_those_of_a_fresh_analysis(seed: int) -> None:
    """After edits, openings and closings, messages and outlines are those of the texts analysed again."""
    rng = random.Random(seed)
    project = Stored(**PROJECT)
    documents = [BODY, HEAD, MOTOR, uri("FB_Motor", "implementation"), uri("E_Mode", "declaration")]
    async with clients(3, project) as three:
        texts: list[dict[str, str]] = [{} for _ in three]
        for version in range(2, 40):
            number = rng.randrange(3)
            client, shown = three[number], texts[number]
            document = rng.choice(documents)
            if document not in shown:
                shown[document] = project.stored(document) or ""
                await client.open(document, shown[document].replace("|", ""))
            elif rng.random() < 0.15:
                del shown[document]
                await client.notify("textDocument/didClose", {"textDocument": {"uri": document}})
            else:
                text = shown[document]
                at = rng.randrange(len(text) + 1)
                text = text[:at] + rng.choice(WORDS) + text[at + rng.choice((0, 0, 1, 4)) :]
                shown[document] = text
                await change(client, document, text, version)
            if rng.random() < 0.3:
                place = {"line": rng.randrange(6), "character": rng.randrange(12)}
                for method in ("hover", "completion", "definition", "references", "documentHighlight"):
                    params: dict[str, Any] = {"textDocument": {"uri": document}, "position": place}
                    if method == "references":
                        params["context"] = {"includeDeclaration": True}
                    answer = await client.answer(f"textDocument/{method}", params)
                    assert answer.get("error", {}).get("code") != -32603, answer
        for client in three:
            await client.session.endpoint.settle()
        analysis = three[0].analysis
        now = analysis.texts.analysed
        final = Stored(
            **{
                name: (now(uri(name, "declaration")) or "", now(uri(name, "implementation")) or "")
                for name in PROJECT
            }
        )
        async with clients(1, final) as (fresh,):
            fresh.analysis.workspace.snapshots()
            expected = sorted(str(d) for d in fresh.analysis.workspace.snapshots()[0].diagnostics)
            found = await analysis.run(
                lambda: sorted(str(d) for d in analysis.workspace.snapshots()[0].diagnostics)
            )
            assert found == expected
