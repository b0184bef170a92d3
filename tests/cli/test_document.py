"""`tappet document`: a project as HTML and PDF, whole or in parts."""

from __future__ import annotations

from pathlib import Path

import pytest
from pypdf import PdfReader
from tests.cli.invoke import invoke

from tappet.project import folder
from tappet.project.new_project import new_project


@pytest.fixture
def project(tmp_path: Path) -> Path:
    folder.save(new_project("Press"), tmp_path / "press")
    return tmp_path / "press"


def test_a_project_and_a_part_of_it(project: Path, tmp_path: Path) -> None:
    pdf, html = tmp_path / "press.pdf", tmp_path / "press.html"
    done = invoke("document", project, "-o", pdf, "--author", "me", "--cross-references")
    assert (done.code, done.output.startswith("Press: ")) == (0, True), done.errors
    assert "PLC_PRG" in "".join(page.extract_text() for page in PdfReader(pdf).pages)
    assert (
        invoke("document", project, "-o", html, "--object", "Task Configuration", "--language", "zh").code
        == 0
    )
    text = html.read_text(encoding="utf-8")
    assert "MainTask" in text
    assert "目录" in text
    assert "Library Manager" not in text


def test_wrong_usage(project: Path, tmp_path: Path) -> None:
    done = invoke("document", project, "-o", tmp_path / "press.doc")
    assert (done.code, "should end in .pdf or .html" in done.errors) == (2, True)
    done = invoke("document", project, "-o", tmp_path / "x.pdf", "--object", "Nothing")
    assert (done.code, "has no object 'Nothing'" in done.errors) == (2, True)
