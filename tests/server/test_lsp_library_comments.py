"""The language server says comments of SM3_Basic in the language of the editor; the project keeps its own."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import pytest
from lsp_client import Client, FakeProject, uri

from tappet.lang.services.documents import Program, library_text
from tappet.lang.source import Scope, Source

BODY = uri("PLC_PRG", "implementation")
BLOCK = """(* Moves the axis to a position. Spec PRO-04. *)
FUNCTION_BLOCK MC_MoveAbsolute
VAR_INPUT
    Position : LREAL; (* Target [u] *)
END_VAR
END_FUNCTION_BLOCK"""
DIRECTION = """(* Direction of a motion. *)
TYPE MC_DIRECTION : (
    shortest, (* The shorter way of a rotary axis *)
    positive
); END_TYPE"""


class MotionProject(FakeProject):
    """Has a block and a type of SM3_Basic."""

    def __call__(self, unsaved: Mapping[str, str]) -> list[Program]:
        (program,) = super().__call__(unsaved)
        texts = [
            library_text(
                Source(
                    f"SM3_Basic/{name}", text, scope=Scope.LIBRARY, library="SM3_Basic", namespace="SM3_Basic"
                )
            )
            for name, text in (("MC_MoveAbsolute", BLOCK), ("MC_DIRECTION", DIRECTION))
        ]
        return [Program(program.name, [*program.texts, *texts])]


def _project() -> MotionProject:
    declaration = """PROGRAM PLC_PRG
VAR
    Move : MC_MoveAbsolute; // The axis
    eWay : MC_DIRECTION;
END_VAR"""
    return MotionProject(PLC_PRG=(declaration, ""))


async def _asked(language: str, method: str, text: str) -> Any:
    async with Client(_project()) as client:
        await client.start(locale=language)
        return await client.ask(f"textDocument/{method}", await client.open(BODY, text))


@pytest.mark.parametrize(
    ("language", "block", "pin"),
    [
        ("zh-CN", "使轴运动到一个位置。", "目标位置 \\[u\\]"),
        ("en", "Moves the axis to a position", "Target \\[u\\]"),
    ],
)
async def test_a_hover_says_what_a_block_and_its_pins_are(language: str, block: str, pin: str) -> None:
    found = (await _asked(language, "hover", "Mo|ve();"))["contents"]["value"]
    assert block in found
    assert "The axis" in found, "a comment of the project"
    assert pin in (await _asked(language, "hover", "Move.Posi|tion := 1;"))["contents"]["value"]
    declared = (await _asked(language, "hover", "Move : MC_Move|Absolute;"))["contents"]["value"]
    assert declared.count(pin.replace("\\", "")) == 1, "behind the pin"
    assert ("运动的方向。" in (await _asked(language, "hover", "e|Way := 0;"))["contents"]["value"]) == (
        language == "zh-CN"
    )


@pytest.mark.parametrize(("language", "said"), [("zh", "目标位置 \\[u\\]"), ("en", "Target \\[u\\]")])
async def test_a_proposal_and_a_call_say_what_a_pin_is(language: str, said: str) -> None:
    items = (await _asked(language, "completion", "Move.|"))["items"]
    (position,) = [item for item in items if item["label"] == "Position"]
    assert position["documentation"]["value"] == said
    (call,) = (await _asked(language, "signatureHelp", "Move(Position := |"))["signatures"]
    assert call["parameters"][0]["documentation"]["value"] == said


async def test_a_proposed_value_of_an_enumeration_says_what_it_is() -> None:
    items = (await _asked("zh", "completion", "eWay := |"))["items"]
    said = {item["label"].rpartition(".")[2]: item.get("documentation", {}).get("value") for item in items}
    assert said["shortest"] == "旋转轴的较短路径"
