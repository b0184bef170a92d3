"""`tappet check --static`: coding rules chosen on the command line."""

from __future__ import annotations

from pathlib import Path

from typer.testing import CliRunner

from tappet.cli import app
from tappet.cli.output import UsageError


def test_rules_are_chosen_by_code(tmp_path: Path) -> None:
    text = "PROGRAM P\nVAR n : INT; END_VAR\nn := n + 1437;\nEND_PROGRAM\n"
    (tmp_path / "p.st").write_text(text)
    plain = CliRunner().invoke(app, ["check", str(tmp_path)])
    chosen = CliRunner().invoke(app, ["check", str(tmp_path), "--static", "S1211"])
    assert (plain.exit_code, chosen.exit_code) == (0, 0)
    assert "S1211" not in plain.output
    assert "p.st:3:10: warning S1211: The number 1437 has no name" in chosen.output
    assert "S1006" not in chosen.output


def test_an_unknown_rule_is_named(tmp_path: Path) -> None:
    (tmp_path / "p.st").write_text("PROGRAM P\nEND_PROGRAM\n")
    result = CliRunner().invoke(app, ["check", str(tmp_path), "--static", "Q7"])
    assert isinstance(result.exception, UsageError)
    assert "'Q7'" in str(result.exception)
