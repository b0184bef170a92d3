"""What is printed of a project: any texts come out again as text, in HTML and PDF, by independent readers."""

from __future__ import annotations

import io
from datetime import datetime
from html.parser import HTMLParser
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pypdf import PdfReader

from tappet.documentation import pdf, typesetting
from tappet.documentation.compose import compose
from tappet.documentation.document import Document, printable
from tappet.documentation.html import write_html
from tappet.documentation.pdf import DocumentTooLargeError, MissingGlyphsError, PdfError, write_pdf
from tappet.documentation.printing import Printing
from tappet.documentation.variables import Declared, declared_variables
from tappet.project import edit
from tappet.project.exchange.parts import chosen_ids
from tappet.project.model import Project
from tappet.project.new_project import new_project

AT = datetime(2026, 1, 2, 3, 4)
MARKUP = "#let x = *a* $b$ <script>alert(1)</script> \\u{41} `c` @d [e] {f} // (* %s & &amp; ' \" ~ _g_ = h"


class Reader(HTMLParser):
    """The texts of a page, and the tags in it."""

    def __init__(self) -> None:
        super().__init__()
        self.text: list[str] = []
        self.tags: set[str] = set()

    def handle_starttag(self, tag: str, attrs: object) -> None:
        self.tags.add(tag)

    def handle_data(self, data: str) -> None:
        self.text.append(data)


def html_text(document: Document) -> tuple[str, set[str]]:
    reader = Reader()
    reader.feed(write_html(document).decode())
    return "".join(reader.text), reader.tags


def pdf_text(document: Document) -> str:
    pages = PdfReader(io.BytesIO(write_pdf(document))).pages
    return "".join(page.extract_text() for page in pages)


def solid(text: str) -> str:
    """Without blanks, which a page puts where it likes."""
    return "".join(text.split()).replace("\u200b", "").replace("\u00a0", "")


def printed(body: str, description: str = "", **how: object) -> Document:
    project = new_project("Press", description)
    program = next(item for item in project.walk() if item.name == "PLC_PRG")
    data = {
        "declaration": "PROGRAM PLC_PRG\nVAR\n  n : INT := 3; // how many\nEND_VAR",
        "implementation": body,
    }
    return compose(edit.change_data(project, program.id, data), Printing.model_validate(how), AT, 7)


TEXTS = st.text(st.characters(codec="utf-8", exclude_characters="\x00"), max_size=200)
LATIN = st.text(st.characters(min_codepoint=32, max_codepoint=0x17E), max_size=60)


@given(TEXTS, TEXTS)
def test_any_text_is_text_in_html(body: str, description: str) -> None:
    text, tags = html_text(printed(body, description))
    assert "script" not in tags
    for line in body.replace("\r\n", "\n").replace("\r", "\n").split("\n"):
        assert solid(printable(line)) in solid(text)


def lines(of: st.SearchStrategy[str]) -> st.SearchStrategy[list[str]]:
    """Several texts for one PDF, which takes long to make."""
    return st.lists(of, min_size=4, max_size=12)


@settings(max_examples=5, deadline=None)
@given(lines(LATIN))
def test_any_text_is_text_in_a_pdf(body: list[str]) -> None:
    # soft hyphens and combining marks are placed by their own rules
    text = solid(pdf_text(printed("\n".join(body), variables=False, contents=False))).replace("\u00ad", "")
    for line in body:
        assert solid(printable(line)).replace("\u00ad", "") in text


@settings(max_examples=5, deadline=None)
@given(lines(st.text(st.sampled_from("#*_`$<>@[]{}\\/~='\"-+%&;:. ab1"), max_size=80)))
def test_what_would_be_markup_is_text_in_a_pdf(body: list[str]) -> None:
    text = solid(pdf_text(printed("\n".join(body), variables=False, contents=False)))
    for line in body:
        assert solid(line) in text


def test_markup_in_every_place_is_text() -> None:
    document = printed(MARKUP, MARKUP, footer=MARKUP.replace("{", "{{"), author=MARKUP)
    text, tags = html_text(document)
    assert text.count(MARKUP) >= 3
    assert "script" not in tags
    assert solid(pdf_text(document)).count(solid(MARKUP)) >= 4


def test_pages_have_contents_numbers_and_tables() -> None:
    document = printed("a := 1;\n\nb := 2;", footer="Plant 4", cross_references=True)
    text = pdf_text(document)
    for part in ("Contents", "Page 2 of ", "Plant 4", "Revision", "2026-01-02 03:04", "VAR", "how many"):
        assert part in text
    assert "Cross references by name" in text
    assert (
        document.sections[-1].blocks[0].rows[0][0],  # type: ignore[union-attr]
        document.sections[-1].blocks[0].rows[0][1].partition("(")[2].rstrip(")"),  # type: ignore[union-attr]
    ) == ("PLC_PRG", "Declaration 1")
    chinese = html_text(printed("a := 1;", language="zh"))[0]
    assert "目录" in chinese
    assert "实现 (ST)" in chinese


def test_characters_without_a_glyph_are_named() -> None:
    """With the fonts of typst alone, as on a machine without Chinese ones."""
    with pytest.raises(
        MissingGlyphsError, match=r"No font of this machine can print 中文 \(2 different"
    ) as raised:
        write_pdf(printed("// 中文中"), system_fonts=False)
    assert raised.value.characters == "中文"
    assert "Noto Sans CJK" in str(raised.value)


def resident_mib() -> int:
    status = Path("/proc/self/status").read_text()
    return int(status.partition("VmRSS:")[2].split()[0]) // 1024


def test_documentations_leave_no_memory_in_use() -> None:
    """Typst keeps its layouts: 100 MiB more after each of these, if a server loaded it."""
    document = printed("\n".join(f"a{line} := b * {line}; // {line}" for line in range(1000)))
    write_pdf(document)
    before = resident_mib()
    for _ in range(2):
        assert len(write_pdf(document)) > 20_000
    assert resident_mib() < before + 30


def test_a_typesetting_that_ends_early_is_an_error(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sys.executable", "/bin/false")
    with pytest.raises(PdfError, match="its process ended with 1; HTML always can"):
        write_pdf(printed("a := 1;"))


@pytest.mark.parametrize(
    ("limit", "value", "said"), [("MEMORY_MIB", 150, "150 MiB of memory"), ("SECONDS", 1, "1 s")]
)
def test_a_typesetting_beyond_its_limits_ends_alone(
    monkeypatch: pytest.MonkeyPatch, limit: str, value: int, said: str
) -> None:
    document = printed("\n".join(f"a{line} := b * {line}; // {line}" for line in range(30_000)))
    with monkeypatch.context() as limited:
        limited.setattr(typesetting, limit, value)
        with pytest.raises(DocumentTooLargeError) as raised:
            write_pdf(document)
    assert f"needs more than {said} to be made. Choose HTML, or print fewer objects" in str(raised.value)
    assert write_pdf(printed("a := 1;")).startswith(b"%PDF")


def test_chosen_objects_only() -> None:
    project = new_project("Press")
    top = next(item for item in project.walk() if item.kind == "task_configuration")
    chosen = chosen_ids(project, [top.id])
    titles = [s.title for s in compose(project, Printing(objects=chosen), AT).sections]
    assert titles == ["Task Configuration", "MainTask"]


def test_a_long_word_stays_on_the_page() -> None:
    word = "x" * 500
    assert solid(word) in solid(pdf_text(printed(word, variables=False)))
    assert pdf._wrapping("a" * 100).count("\u200b") == 2


@pytest.mark.parametrize(
    ("text", "rows"),
    [
        (
            "VAR_INPUT CONSTANT\n  // above\n  a, b AT %MW0 : INT(0..5) := 3; (* behind *)\nEND_VAR",
            [
                Declared("a", "VAR_INPUT CONSTANT", "INT(0..5)", "3", "%MW0", "behind"),
                Declared("b", "VAR_INPUT CONSTANT", "INT(0..5)", "3", "%MW0", "behind"),
            ],
        ),
        (
            "VAR_GLOBAL\n  {attribute 'x'} s : STRING := 'a;b : c';\n  // of t\n  t : TON;\nEND_VAR",
            [
                Declared("s", "VAR_GLOBAL", "STRING", "'a;b : c'", "", ""),
                Declared("t", "VAR_GLOBAL", "TON", "", "", "of t"),
            ],
        ),
        (
            "VAR\n a : ARRAY [0..1] OF INT := [1, 2]; x\nEND_VAR",
            [Declared("a", "VAR", "ARRAY [0..1] OF INT", "[1, 2]", "", "")],
        ),
        ("TYPE t : (a, b); END_TYPE", []),
    ],
)
def test_variables_of_a_declaration(text: str, rows: list[Declared]) -> None:
    assert declared_variables(text) == rows


@given(TEXTS)
def test_any_declaration_is_read(text: str) -> None:
    for row in declared_variables(text):
        assert row.scope.startswith("VAR")


def test_an_empty_project() -> None:
    assert "Empty" in pdf_text(compose(Project("Empty"), Printing(), AT))
