"""Each feature of the language server once, as an editor uses it."""

from __future__ import annotations

from typing import Any

import pytest
from lsp_client import Client, FakeProject, uri
from lsp_project import BODY, DECLARATION, HEAD, PROJECT, here, start

from tappet.lang.analysis.edits import declaration_edits
from tappet.lang.services.semantic_tokens import TOKEN_TYPES
from tappet.server.lsp import rpc


async def test_initialize_tells_what_is_served() -> None:
    async with start() as client:
        result = await client.start()
        capabilities = result["capabilities"]
        assert capabilities["positionEncoding"] == "utf-16"
        assert capabilities["textDocumentSync"]["change"] == 2
        assert capabilities["renameProvider"] == {"prepareProvider": True}
        assert capabilities["semanticTokensProvider"]["legend"]["tokenTypes"] == list(TOKEN_TYPES)
        assert result["serverInfo"]["name"] == "tappet"


async def test_diagnostics_follow_the_typing() -> None:
    async with start() as client:
        await client.start()
        await client.open(BODY, "iCount := 1;\nmotor.xOff := TRUE;\nIF iCount THEN")
        found = {d["code"]: d for d in await client.published(BODY)}
        assert found["E0204"]["range"] == here(1, 6, 10)
        assert found["E0204"]["severity"] == 1
        assert found["E0204"]["source"] == "tappet"
        assert found["E0103"]["range"]["start"]["line"] == 2
        assert found["E0103"]["data"]["advice"] == "Close the IF with END_IF."
        facts = found["E0103"]["data"]["facts"]
        assert (facts["begin"], facts["end"], facts["found"]) == ("IF", "END_IF", "END_PROGRAM")
        change = {"range": here(1, 6, 10), "text": "xOn"}
        rest = {
            "range": {"start": {"line": 1, "character": 18}, "end": {"line": 9, "character": 0}},
            "text": "\n",
        }
        identifier = {"uri": BODY, "version": 2}
        await client.notify(
            "textDocument/didChange", {"textDocument": identifier, "contentChanges": [change, rest]}
        )
        assert await client.published(BODY) == []
        await client.notify("textDocument/didClose", {"textDocument": {"uri": BODY}})
        assert (
            await client.ask(
                "textDocument/hover", {"textDocument": {"uri": BODY}, "position": here(0, 0, 0)["start"]}
            )
        ) is not None


async def test_diagnostics_speak_the_language_of_the_client() -> None:
    async with start() as client:
        await client.start(locale="zh-CN")
        asked = await client.open(BODY, "iCont := 1;")
        (found,) = [d for d in await client.published(BODY) if d["code"] == "E0201"]
        assert found["message"] == "标识符“iCont”未定义"
        asked |= {"range": found["range"], "context": {"diagnostics": [found]}}
        actions = await client.ask("textDocument/codeAction", asked)
        assert actions
        assert all(action["diagnostics"] == [found] for action in actions)


async def test_diagnostics_name_related_places_and_tags() -> None:
    async with start() as client:
        await client.start()
        await client.open(
            HEAD, "PROGRAM PLC_PRG\nVAR\n  iCount : INT;\n  ICOUNT : INT;\n  iUnused : INT;\nEND_VAR"
        )
        found = {d["code"]: d for d in await client.published(HEAD)}
        (related,) = found["E0205"]["relatedInformation"]
        assert related["location"] == {"uri": HEAD, "range": here(2, 2, 8)}
        assert found["W1103"]["tags"] == [1]


async def test_a_text_opened_later_is_told_what_was_found_in_it_before() -> None:
    async with start(Other=("PROGRAM Other", "xNowhere := TRUE;")) as client:
        await client.start()
        other = uri("Other", "implementation")
        assert [d["code"] for d in await client.published(other)] == ["E0201"]
        await client.open(other, "xNowhere := TRUE;")
        assert [d["code"] for d in await client.published(other)] == ["E0201"]


async def test_stored_texts_of_others_count() -> None:
    project = FakeProject(**PROJECT)
    async with Client(project) as client:
        await client.start()
        await client.open(BODY, "g_x := 1;")
        assert [d["code"] for d in await client.published(BODY)] == ["E0201"]
        project.objects["GVL"] = ("VAR_GLOBAL g_x : INT; END_VAR", "")
        client.analysis.stored_texts_changed()
        assert await client.published(BODY) == []


async def test_completion() -> None:
    async with start() as client:
        await client.start()
        params = await client.open(BODY, "motor.x|")
        found = (await client.ask("textDocument/completion", params))["items"]
        assert [item["label"] for item in found] == ["xOn", "xRuns"]
        first = found[0]
        assert first["textEdit"] == {"range": here(0, 6, 7), "newText": "xOn"}
        assert first["documentation"]["value"] == "run"
        assert first["detail"] == "BOOL"
        await client.open(BODY, "")
        params = await client.open(BODY, "motor(|")
        found = (await client.ask("textDocument/completion", params))["items"]
        assert [(i["label"], i["textEdit"]["newText"], i["filterText"]) for i in found[:3]] == [
            ("xOn :=, xRuns =>", "xOn := $1, xRuns => $2", "xOn :=, xRuns =>"),
            ("xOn :=", "xOn := ", "xOn"),
            ("xRuns =>", "xRuns => ", "xRuns"),
        ]
        assert [i["sortText"] for i in found] == sorted(i["sortText"] for i in found)
        snippet = next(i for i in (await complete_at(client, "|"))["items"] if i["label"] == "IF ... END_IF")
        assert snippet["insertTextFormat"] == 2


async def complete_at(client: Client, text: str) -> dict[str, Any]:
    params = await client.open(BODY, text)
    found: dict[str, Any] = await client.ask("textDocument/completion", params)
    return found


async def test_completion_that_replaces_the_dot() -> None:
    async with start(PLC_PRG=("PROGRAM PLC_PRG\nVAR p : POINTER TO E_Mode; END_VAR", "")) as client:
        await client.start()
        (item,) = (await complete_at(client, "p.|"))["items"]
        assert item["textEdit"] == {"range": here(0, 1, 2), "newText": "^"}
        assert item["filterText"] == ".^"


async def test_hover() -> None:
    async with start() as client:
        await client.start()
        found = await client.ask("textDocument/hover", await client.open(BODY, "mot|or(xOn := TRUE);"))
        assert found["contents"]["kind"] == "markdown"
        assert (
            found["contents"]["value"] == "```iec-st\nVAR motor : FB_Motor;\n```\n\nthe drive\n\nin PLC\\_PRG"
        )
        assert found["range"] == here(0, 0, 5)
        assert await client.ask("textDocument/hover", await client.open(BODY, "// no|thing")) is None


async def test_signature_help() -> None:
    async with start() as client:
        await client.start()
        params = await client.open(BODY, "motor(xOn := |")
        found = await client.ask("textDocument/signatureHelp", params)
        (information,) = found["signatures"]
        assert information["label"] == "FB_Motor(xOn : BOOL, xRuns => : BOOL)"
        assert information["parameters"][0]["label"] == [9, 19]
        assert information["parameters"][0]["documentation"]["value"] == "run"
        assert found["activeParameter"] == 0


async def test_definition_over_documents() -> None:
    async with start() as client:
        await client.start()
        params = await client.open(BODY, "motor.xO|n := TRUE;")
        found = await client.ask("textDocument/definition", params)
        assert found == {"uri": uri("FB_Motor", "declaration"), "range": here(2, 4, 7)}
        params = await client.open(BODY, "|motor.xOn := TRUE;")
        assert (await client.ask("textDocument/definition", params))["uri"] == HEAD
        found = await client.ask("textDocument/typeDefinition", params)
        assert found == {"uri": uri("FB_Motor", "declaration"), "range": here(0, 15, 23)}


async def test_definition_in_a_library_can_be_read() -> None:
    async with start(PLC_PRG=("PROGRAM PLC_PRG\nVAR t : TON; END_VAR", "")) as client:
        await client.start()
        found = await client.ask("textDocument/definition", await client.open(BODY, "t.P|T := T#1s;"))
        assert found["uri"] == "tappet-library:/Standard/TON"
        document = await client.ask("tappet/document", {"uri": found["uri"]})
        line = document["text"].split("\n")[found["range"]["start"]["line"]]
        assert line[found["range"]["start"]["character"] :].startswith("PT : TIME")
        assert "There is no document" in (await client.refused("tappet/document", {"uri": "x"}))["message"]


async def test_short_forms_are_expanded() -> None:
    """DECL-13, LDEC-142: what Ctrl+Enter asks for."""
    async with start() as client:
        await client.start()
        assert await client.ask("tappet/shorthand", {"line": "n I 2; parts"}) == {
            "line": "n: INT := 2; (* parts *)"
        }
        assert await client.ask("tappet/shorthand", {"line": "n : INT;"}) == {"line": None}
        assert "`line`" in (await client.refused("tappet/shorthand", {}))["message"]


async def test_references_and_highlights() -> None:
    async with start() as client:
        await client.start()
        params = await client.open(BODY, "iC|ount := iCount + 1;")
        found = await client.ask(
            "textDocument/references", {**params, "context": {"includeDeclaration": True}}
        )
        assert [(f["uri"], f["range"]) for f in found] == [
            (HEAD, here(3, 4, 10)),
            (BODY, here(0, 0, 6)),
            (BODY, here(0, 10, 16)),
        ]
        found = await client.ask(
            "textDocument/references", {**params, "context": {"includeDeclaration": False}}
        )
        assert len(found) == 2
        found = await client.ask("textDocument/documentHighlight", params)
        assert [(f["range"], f["kind"]) for f in found] == [(here(0, 0, 6), 3), (here(0, 10, 16), 2)]


async def test_implementation() -> None:
    interface = ("INTERFACE I_Run END_INTERFACE", "")
    block = ("FUNCTION_BLOCK FB_Run IMPLEMENTS I_Run", "")
    async with start(I_Run=interface, FB_Run=block) as client:
        await client.start()
        params = await client.open(uri("I_Run", "declaration"), "INTERFACE I_R|un END_INTERFACE")
        found = await client.ask("textDocument/implementation", params)
        assert [f["uri"] for f in found] == [uri("FB_Run", "declaration")]


async def test_rename() -> None:
    async with start() as client:
        await client.start()
        params = await client.open(BODY, "iC|ount := iCount + 1;")
        found = await client.ask("textDocument/prepareRename", params)
        assert found == {"range": here(0, 0, 6), "placeholder": "iCount"}
        edit = await client.ask("textDocument/rename", {**params, "newName": "iPieces"})
        assert edit["changes"] == {
            HEAD: [{"range": here(3, 4, 10), "newText": "iPieces"}],
            BODY: [
                {"range": here(0, 0, 6), "newText": "iPieces"},
                {"range": here(0, 10, 16), "newText": "iPieces"},
            ],
        }
        error = await client.refused("textDocument/rename", {**params, "newName": "motor"})
        assert error == {"code": rpc.REQUEST_FAILED, "message": "'motor' exists already"}
        params = await client.open(BODY, "I|F TRUE THEN END_IF")
        assert "Nothing" in (await client.refused("textDocument/prepareRename", params))["message"]


async def test_symbols_of_a_document_and_of_all() -> None:
    async with start() as client:
        await client.start()
        (found,) = await client.ask("textDocument/documentSymbol", {"textDocument": {"uri": HEAD}})
        assert (found["name"], found["kind"], found["range"]["end"]["line"]) == ("PLC_PRG", 2, 4)
        (section,) = found["children"]
        assert [(c["name"], c["detail"]) for c in section["children"]] == [
            ("motor", "FB_Motor"),
            ("iCount", "INT"),
        ]
        all_ = await client.ask("workspace/symbol", {"query": "mo"})
        assert {(s["name"], s["location"]["uri"]) for s in all_} == {
            ("FB_Motor", uri("FB_Motor", "declaration")),
            ("E_Mode", uri("E_Mode", "declaration")),
            ("motor", HEAD),
        }
        (first, *_) = await client.ask("workspace/symbol", {"query": "icount"})
        assert (first["name"], first["containerName"]) == ("iCount", "PLC_PRG")
        scattered = await client.ask("workspace/symbol", {"query": "icnt"})
        assert [symbol["name"] for symbol in scattered] == ["iCount"]
        assert await client.ask("workspace/symbol", {"query": "tnci"}) == []


async def test_jump_labels_are_symbols() -> None:
    body = "motor: iCount := 1;\nJMP Later;\nLater:\nJMP motor;\n"
    async with start(PLC_PRG=(DECLARATION, body)) as client:
        await client.start()
        (label,) = await client.ask("workspace/symbol", {"query": "later"})
        assert (label["name"], label["kind"], label["containerName"]) == ("Later", 20, "PLC_PRG")
        assert label["location"] == {"uri": BODY, "range": here(2, 0, 5)}
        both = await client.ask("workspace/symbol", {"query": "motor"})
        assert {(one["name"], one["kind"]) for one in both} == {("FB_Motor", 5), ("motor", 13), ("motor", 20)}


async def test_formatting() -> None:
    async with start() as client:
        await client.start()
        params = await client.open(BODY, "if iCount=1 then\niCount:=2;\nend_if")
        options = {"tabSize": 2, "insertSpaces": True}
        found = await client.ask("textDocument/formatting", {**params, "options": options})
        assert [(f["range"]["start"]["line"], f["newText"]) for f in found] == [
            (0, "IF iCount = 1 THEN"),
            (1, "  iCount := 2;"),
            (2, "END_IF"),
        ]


async def test_formatting_follows_the_settings() -> None:
    async with start() as client:
        await client.start()
        params = await client.open(BODY, "IF iCount=1 THEN f(1,2); END_IF")
        chosen = {"keywords": "lower", "operators": False, "commas": False, "other": 1}
        options = {"tabSize": 4, "insertSpaces": True}
        for settings, expected in (
            ({"tappet": {"format": chosen}}, "if iCount=1 then f(1,2); end_if"),
            (
                {"tappet": {"format": {"keywords": "shouting", "operators": 3}}},
                "IF iCount = 1 THEN f(1, 2); END_IF",
            ),
            (None, "IF iCount = 1 THEN f(1, 2); END_IF"),
        ):
            await client.notify("workspace/didChangeConfiguration", {"settings": settings})
            (found,) = await client.ask("textDocument/formatting", {**params, "options": options})
            assert found["newText"] == expected


async def test_code_actions_mend_a_message() -> None:
    async with start() as client:
        await client.start()
        params = await client.open(BODY, "xNew := TRUE;\niCoun := 1;")
        whole = {"start": {"line": 0, "character": 0}, "end": {"line": 1, "character": 3}}
        found = await client.ask(
            "textDocument/codeAction", {**params, "range": whole, "context": {"diagnostics": []}}
        )
        by_key = {(a["data"]["key"], a["diagnostics"][0]["range"]["start"]["line"]): a for a in found}
        declared = by_key["declareAs", 0]["edit"]["changes"]
        assert declared == {HEAD: [{"range": here(4, 0, 0), "newText": "    xNew : BOOL;\n"}]}
        assert by_key["declare", 0]["data"]["declare"] == {"name": "xNew", "type": "BOOL"}
        replaced = by_key["replace", 1]
        # What declares an unknown name comes first; another name is a guess.
        assert by_key["declareAs", 1]["isPreferred"]
        assert "isPreferred" not in replaced
        assert replaced["data"]["values"] == {"name": "iCount"}
        assert replaced["edit"]["changes"] == {BODY: [{"range": here(1, 0, 5), "newText": "iCount"}]}


async def test_cross_references_by_place_and_by_name() -> None:
    async with start() as client:
        await client.start()
        params = await client.open(BODY, "iCount := iCount + 1;")
        at = {**params, "position": {"line": 0, "character": 2}}
        by_place = await client.ask("tappet/crossReferences", at)
        assert [(r["access"], r["uri"], r["symbol"]) for r in by_place] == [
            ("declaration", HEAD, "PLC_PRG.iCount"),
            ("write", BODY, "PLC_PRG.iCount"),
            ("read", BODY, "PLC_PRG.iCount"),
        ]
        assert by_place[1]["text"] == "iCount := iCount + 1;"
        assert by_place == await client.ask("tappet/crossReferences", {"name": "plc_prg.icount"})
        assert (await client.refused("tappet/crossReferences", {}))["code"] == rpc.REQUEST_FAILED
        for bad in ({"name": "x" * 501}, {"textDocument": {"uri": BODY}, "position": 3}):
            assert (await client.refused("tappet/crossReferences", bad))["code"] == rpc.INVALID_PARAMS


async def test_help_for_the_cells_of_a_table() -> None:
    """IL-01, IL-04: proposals in a text that is only tried, facts of operands."""
    async with start() as client:
        await client.start()
        params = await client.open(BODY, "LD iCount\nST iCount")
        tried = {**params, "position": {"line": 1, "character": 6}, "text": "LD iCount\nST iCo"}
        found = await client.ask("tappet/completionIn", tried)
        assert "iCount" in [item["label"] for item in found["items"]]
        asked = {**params, "operands": ["iCount", "nowhere"]}
        facts = await client.ask("tappet/operandFacts", asked)
        assert facts == [{"type": "INT", "address": "", "comment": ""}, None]
        for bad in ({}, {**params, "operands": ["x" * 501]}, {**params, "operands": "x"}, []):
            assert (await client.refused("tappet/operandFacts", bad))["code"] == rpc.INVALID_PARAMS
        for bad in ({}, {**tried, "text": 3}, {**tried, "position": {}}):
            assert (await client.refused("tappet/completionIn", bad))["code"] == rpc.INVALID_PARAMS


async def test_folding() -> None:
    async with start() as client:
        await client.start()
        found = await client.ask("textDocument/foldingRange", {"textDocument": {"uri": HEAD}})
        assert {(f["startLine"], f["endLine"]) for f in found} == {(0, 4), (1, 4)}


async def test_semantic_tokens_are_packed_in_utf_16() -> None:
    async with start() as client:
        await client.start()
        params = await client.open(BODY, "iCount := 1; // \U0001f600 x\n  motor();")
        found = await client.ask("textDocument/semanticTokens/full", params)
        data = found["data"]
        tokens = [tuple(data[i : i + 5]) for i in range(0, len(data), 5)]
        kinds = [TOKEN_TYPES[token[3]] for token in tokens]
        assert kinds == ["variable", "operator", "number", "comment", "variable"]
        assert [token[:3] for token in tokens] == [(0, 0, 6), (0, 7, 2), (0, 3, 1), (0, 3, 7), (1, 2, 5)]


async def test_an_edited_text_is_told_of_before_the_others(monkeypatch: pytest.MonkeyPatch) -> None:
    """An edit that concerns many texts: theirs are checked behind the messages of the edited one."""
    monkeypatch.setattr(declaration_edits, "AT_ONCE", 0)
    block = "FUNCTION_BLOCK FB_Count\nVAR_OUTPUT\n    {} : INT;\nEND_VAR"
    use = ("PROGRAM {}\nVAR f : FB_Count; n : INT; END_VAR", "n := f.a;")
    users = {name: (use[0].format(name), use[1]) for name in ("Use1", "Use2")}
    first, later = uri("FB_Count", "implementation"), uri("Use1", "implementation")
    async with start(FB_Count=(block.format("b"), "a := 1;"), **users) as client:
        await client.start()
        head = uri("FB_Count", "declaration")
        await client.open(head, block.format("b"))
        assert [d["code"] for d in await client.published(later)] == ["E0204"]
        for name, codes in (("a", []), ("b", ["E0201", "E0204"])):
            change = {"range": here(2, 4, 5), "text": name}
            changed = {"textDocument": {"uri": head, "version": 2}, "contentChanges": [change]}
            client.notified.clear()
            await client.notify("textDocument/didChange", changed)
            assert [d["code"] for d in await client.published(first)] == codes[:1]
            assert [d["code"] for d in await client.published(later)] == codes[1:]
