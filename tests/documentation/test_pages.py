"""Printed pages follow the page setup: the PDF is read by pypdf."""

from __future__ import annotations

import base64
import io
import re
from datetime import datetime
from typing import Any

import pytest
from PIL import Image
from pypdf import PdfReader
from pypdf._page import PageObject

from tappet.documentation.compose import compose
from tappet.documentation.document import Document, Listing
from tappet.documentation.html import write_html
from tappet.documentation.pdf import write_pdf
from tappet.documentation.printing import Printing
from tappet.project import edit
from tappet.project.data import SPLIT_TEXTS, UnknownData
from tappet.project.errors import InvalidDataError, ProjectError
from tappet.project.kinds.page_setup import PAGE_SETUP
from tappet.project.kinds.script import SCRIPT, ScriptData
from tappet.project.model import Project, ProjectObject
from tappet.project.new_project import new_project
from tappet.project.papers import PAPERS

AT = datetime(2026, 1, 2, 3, 4)
POINTS = 72 / 25.4
"""To the mm."""


def picture(form: str, size: tuple[int, int] = (300, 100)) -> str:
    file = io.BytesIO()
    Image.new("RGB", size, "#0a58ca").save(file, form)
    return base64.b64encode(file.getvalue()).decode()


def project_with(**setup: Any) -> Project:
    project, item = edit.add_object(new_project("Press"), None, PAGE_SETUP.name)
    return edit.change_data(project, item.id, setup)


def document(printing: Printing | None = None, **setup: Any) -> Document:
    return compose(project_with(**setup), printing or Printing(printed_by="eve"), AT, 7)


def pages(of: Document) -> list[PageObject]:
    return list(PdfReader(io.BytesIO(write_pdf(of))).pages)


def style(of: Document) -> str:
    return write_html(of).decode().partition("<style>")[2].partition("</style>")[0]


def placed(page: PageObject) -> list[tuple[str, float, float]]:
    """Texts and where they begin, in points from the lower left corner."""
    found: list[tuple[str, float, float]] = []

    def visit(text: str, page_at: list[float], at: list[float], *_: object) -> None:
        a, b, c, d, x, y = page_at
        if text.strip():
            found.append((text, a * at[4] + c * at[5] + x, b * at[4] + d * at[5] + y))

    page.extract_text(visitor_text=visit)
    return found


def top(page: PageObject, margin_mm: float) -> str:
    """The texts in the margin at the top."""
    edge = float(page.mediabox.height) - margin_mm * POINTS
    return " ".join(text for text, _, y in placed(page) if y > edge)


@pytest.mark.parametrize("orientation", ["portrait", "landscape"])
@pytest.mark.parametrize("paper", PAPERS)
def test_size_of_the_paper(paper: Any, orientation: Any) -> None:
    composed = document(paper=paper, orientation=orientation)
    width, height = PAPERS[paper] if orientation == "portrait" else reversed(PAPERS[paper])
    for page in pages(composed):
        assert [float(one) for one in page.mediabox[2:]] == pytest.approx(
            [width * POINTS, height * POINTS], abs=0.01
        )
    assert f"@page {{ size: {width:g}mm {height:g}mm; margin: 22mm 17mm 20mm 17mm;" in style(composed)


def test_margins() -> None:
    composed = document(margins={"top": 40.5, "left": 60, "right": 50, "bottom": 70}, header={"left": ""})
    places = placed(pages(composed)[2])
    assert min(x for _, x, _ in places) == pytest.approx(60 * POINTS, abs=1)
    assert max(x for _, x, _ in places) < (210 - 50) * POINTS
    assert max(y for _, _, y in places) < (297 - 40.5) * POINTS
    assert [text.strip() for text, _, y in places if y < 70 * POINTS] == [f"Page 3 of {len(pages(composed))}"]
    assert "margin: 40.5mm 50mm 70mm 60mm;" in style(composed)


def test_head_and_foot_with_placeholders() -> None:
    composed = document(
        company="ACME",
        author="me",
        header={"left": "{project} {{x}", "centre": "{object}", "right": "{path}"},
        footer={
            "left": "{company}, {author}, r{revision}",
            "centre": "{date} {time}",
            "right": "{page}/{pages}",
        },
    )
    found = pages(composed)
    texts = [page.extract_text() for page in found]
    assert top(found[0], 22) == ""
    for number, text in enumerate(texts, 1):
        assert "ACME, me, r7" in text
        assert "2026-01-02 03:04" in text
        assert f"{number}/{len(found)}" in text
    heads = [" ".join(top(page, 22).split()) for page in found[1:]]
    assert heads[0] == "Press {x}"  # nothing has begun before the contents
    assert heads[1] == "Press {x} Tappet Soft PLC Tappet Soft PLC"
    assert heads[-1].endswith("Page Setup Page Setup")


def test_the_object_of_a_page_is_the_first_one_that_begins_there() -> None:
    project = project_with(header={"left": "", "right": "<{object}|{path}>"}, contents=False)
    program = next(item for item in project.walk() if item.name == "PLC_PRG")
    body = "\n".join(f"a{line} := {line};" for line in range(200))
    project = edit.change_data(
        project, program.id, {"declaration": "PROGRAM PLC_PRG", "implementation": body}
    )
    heads = [" ".join(top(page, 22).split()) for page in pages(compose(project, Printing(), AT))]
    path = project.path_of(program.id)
    assert heads[:2] == ["", "<Tappet Soft PLC|Tappet Soft PLC>"]
    assert heads[2:4] == [f"<PLC_PRG|{path}>"] * 2
    assert "Page Setup" not in heads[-2]
    assert len(heads) >= 5


def test_the_default_is_what_was_printed_without_a_page_setup() -> None:
    composed = compose(new_project("Press"), Printing(footer="Plant 4", printed_by="eve"), AT, 7)
    found = pages(composed)
    assert [float(one) for one in found[0].mediabox[2:]] == pytest.approx([595.28, 841.89], abs=0.01)
    text = found[1].extract_text()
    assert (top(found[0], 22), top(found[1], 22).strip()) == ("", "Press")
    assert "Plant 4" in text
    assert "Page 2 of 3" in text
    assert ("Author", "eve") in composed.facts


def test_no_title_page() -> None:
    with_one, without = pages(document()), pages(document(title_page=False, logo=picture("PNG")))
    assert len(without) == len(with_one) - 1
    assert "Revision" in with_one[0].extract_text()
    first = without[0].extract_text()
    assert "Revision" not in first
    assert "Contents" in first
    assert top(without[0], 22).strip() == "Press"
    assert [len(page.images) for page in without] == [0] * len(without)
    html = write_html(document(title_page=False)).decode()
    assert "<header>" not in html
    assert "@page :first" not in html


@pytest.mark.parametrize("form", ["PNG", "JPEG"])
def test_the_logo_on_the_title_page_and_in_the_head(form: str) -> None:
    logo = picture(form)
    composed = document(logo=logo, logo_in_header="right")
    found = pages(composed)
    assert all(len(page.images) == 1 for page in found)
    assert found[0].images[0].image is not None
    assert found[0].images[0].image.size == (300, 100)
    assert [len(page.images) for page in pages(document(logo=logo))][:2] == [1, 0]
    only_head = document(logo=logo, logo_on_title_page=False, logo_in_header="left")
    assert [len(page.images) for page in pages(only_head)][:2] == [0, 1]
    html = write_html(composed).decode()
    uri = f"data:image/{form.lower()};base64,{logo}"
    assert f'<img src="{uri}" alt="" style="width: 80mm; height: 26.67mm">' in html
    assert "@top-right {" in html
    assert "data:image/svg+xml,%3Csvg" in html
    assert "default-src 'none'; style-src 'unsafe-inline'; img-src data:" in html


def test_shapes_of_logos_fit_their_places() -> None:
    wide, high = (document(logo=picture("PNG", size)).logo for size in ((4000, 10), (10, 4000)))
    assert wide is not None
    assert high is not None
    assert (wide.size_on_title_page(), wide.size_in_header(22)) == ((80, 0.2), (40, 0.1))
    assert (high.size_on_title_page(), high.size_in_header(5)) == ((0.1, 40), (0.01, 3))
    for logo in (wide, high):
        assert len(
            pages(compose(project_with(logo=base64.b64encode(logo.picture.content).decode()), Printing(), AT))
        )


def test_html_heads_take_no_text_for_css() -> None:
    nasty = "\"}</style><script>alert(1)</script>\\' url(x) {{object} é 中"
    css = style(document(header={"left": nasty, "right": "{object} of {project}"}))
    assert "script" not in css.replace(r"\3c script\3e ", "").replace(r"\3c \2f script\3e ", "")
    assert "é" in css
    string = re.search(r'@top-left \{[^"]*content: "([^"]*)"', css)
    assert string is not None
    plain = re.sub(r"\\([0-9a-f]+) ", lambda match: chr(int(match[1], 16)), string[1])
    assert plain == nasty.replace("{{", "{")
    # a browser without named strings takes the first declaration, one with them the second
    right = css.partition("@top-right")[2]
    assert right.index('content: " of " "Press"') < right.index('content: string(object) " of " "Press"')
    assert "string-set: object attr(data-object), path attr(data-path)" in css


def test_a_request_goes_before_the_page_setup() -> None:
    given = Printing(
        paper="us-letter",
        orientation="portrait",
        contents=False,
        title_page=True,
        author="Ann",
        footer="{author} prints",
        printed_by="eve",
    )
    composed = document(
        given,
        paper="a3",
        orientation="landscape",
        title_page=False,
        author="Bob",
        footer={"left": "own", "right": "right"},
        variables=False,
        cross_references=True,
    )
    assert (composed.sheet.width, composed.sheet.height) == PAPERS["us-letter"]
    assert (composed.title_page, composed.contents) == (True, "")
    assert ("Author", "Ann") in composed.facts
    assert [[piece.text for piece in text] for text in composed.footer] == [["Ann", " prints"], [], ["right"]]
    assert composed.sections[-1].title == "Cross references by name"
    own = document(author="Bob")
    assert ("Author", "Bob") in own.facts


def test_a_request_that_does_not_fit_the_margins() -> None:
    with pytest.raises(
        InvalidDataError, match="This cannot be printed: data: the margins left and right leave"
    ):
        document(Printing(paper="a5"), paper="a3", margins={"left": 70, "right": 70})


def test_data_of_another_version_are_named() -> None:
    project = project_with()
    (item,) = project.find_kind(PAGE_SETUP.name)
    strange = UnknownData.model_validate({"paper": "a9"})
    broken = ProjectObject(id=item.id, kind=item.kind, name=item.name, data=strange)
    with pytest.raises(ProjectError, match="The data of 'Page Setup' do not fit this version"):
        compose(Project("Press", objects={item.id: broken}), Printing(), AT)


def test_scripts_are_listings_with_line_numbers() -> None:
    project, item = edit.add_object(new_project("Press"), None, SCRIPT.name)
    project = edit.change_data(project, item.id, ScriptData(text="const a = 1;\n\n// <b>\n"))
    composed = compose(project, Printing(objects=frozenset([item.id])), AT)
    (block,) = composed.sections[0].blocks
    assert isinstance(block, Listing)
    assert ["".join(run.text for run in line) for line in block.lines] == ["const a = 1;", "", "// <b>"]
    assert (
        '<pre><span class="l"><span class="code">const a = 1;</span></span>' in write_html(composed).decode()
    )
    assert "3 // <b>" in pages(composed)[-1].extract_text()


def test_texts_of_a_plug_in_that_is_missing_are_listings() -> None:
    data = UnknownData.model_validate({"about": "x", "text": "a\nb", SPLIT_TEXTS: {"text": "md"}})
    item = ProjectObject(id="0" * 32, kind="machine_note", name="Note", data=data)
    listing, table = compose(Project("Press", objects={item.id: item}), Printing(), AT).sections[0].blocks
    assert isinstance(listing, Listing)
    assert len(listing.lines) == 2
    assert table.rows == (("about", "x"),)  # type: ignore[union-attr]


def test_the_bytes_of_a_logo_are_not_printed() -> None:
    logo = picture("PNG")
    rows = dict(document(logo=logo).sections[-1].blocks[0].rows)  # type: ignore[union-attr, arg-type]
    assert rows["logo"] == f"{len(logo) * 3 // 4:,} B"
    assert rows["paper"] == "a4"
