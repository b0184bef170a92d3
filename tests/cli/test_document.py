"""`tappet document`: a project as HTML and PDF, whole or in parts."""

from __future__ import annotations

from pathlib import Path

import pytest
from pypdf import PdfReader
from tests.cli.invoke import invoke

from tappet.project import edit, folder
from tappet.project.kinds.page_setup import PAGE_SETUP
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


def test_the_page_setup_of_the_folder_and_what_goes_before_it(tmp_path: Path) -> None:
    made, item = edit.add_object(new_project("Press"), None, PAGE_SETUP.name)
    made = edit.change_data(
        made, item.id, {"paper": "a3", "orientation": "landscape", "footer": {"left": "own"}}
    )
    folder.save(made, tmp_path / "press")
    pdf = tmp_path / "press.pdf"

    def sizes(*options: str) -> tuple[int, int, int]:
        done = invoke("document", tmp_path / "press", "-o", pdf, *options)
        assert done.code == 0, done.errors
        pages = PdfReader(pdf).pages
        return round(pages[0].mediabox.width), round(pages[0].mediabox.height), len(pages)

    width, height, count = sizes()
    assert (width, height) == (1191, 842)
    assert "own" in PdfReader(pdf).pages[0].extract_text()
    assert sizes("--no-title-page") == (1191, 842, count - 1)
    assert sizes("--orientation", "portrait")[:2] == (842, 1191)
    assert sizes("--paper", "us-legal", "--no-contents")[:2] == (1008, 612)
    assert sizes("--footer", "{author}", "--author", "Ann")
    assert "Ann" in PdfReader(pdf).pages[1].extract_text()
    done = invoke("document", tmp_path / "press", "-o", pdf, "--footer", "{x}")
    assert (done.code, "footer: '{x}' is no placeholder" in done.errors) == (2, True)
