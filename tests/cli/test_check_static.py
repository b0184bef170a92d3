"""`tappet check --static`: coding rules chosen on the command line."""

from __future__ import annotations

from pathlib import Path

from tests.cli.invoke import invoke


def test_rules_are_chosen_by_code(tmp_path: Path) -> None:
    text = "PROGRAM P\nVAR n : INT; END_VAR\nn := n + 1437;\nEND_PROGRAM\n"
    (tmp_path / "p.st").write_text(text)
    plain = invoke("check", tmp_path)
    chosen = invoke("check", tmp_path, "--static", "S1211")
    assert (plain.code, chosen.code) == (0, 0)
    assert "S1211" not in plain.output
    assert "p.st:3:10: warning S1211: The number 1437 has no name" in chosen.output
    assert "S1006" not in chosen.output


def test_an_unknown_rule_is_named(tmp_path: Path) -> None:
    (tmp_path / "p.st").write_text("PROGRAM P\nEND_PROGRAM\n")
    result = invoke("check", tmp_path, "--static", "Q7")
    assert result.code == 2
    assert "'Q7'" in result.errors
