"""The page setup: what it holds, what it refuses and with which words, its logo, its way through a folder."""

from __future__ import annotations

import base64
import io
import re
import zlib
from pathlib import Path
from typing import Any

import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from PIL import Image
from pydantic import ValidationError

from tappet.project import edit, folder
from tappet.project.compare.differences import Comparison
from tappet.project.errors import InvalidDataError, NotPlaceableError
from tappet.project.kinds.page_setup import PAGE_SETUP
from tappet.project.model import Project
from tappet.project.new_project import new_project
from tappet.project.objects import describe
from tappet.project.page_setup import PageSetupData
from tappet.project.papers import PAPERS
from tappet.project.picture import read_picture
from tappet.project.running_text import PLACEHOLDERS, Piece, pieces_of

ROOT = Path(__file__).parents[2]


def picture(form: str = "PNG", size: tuple[int, int] = (40, 20)) -> bytes:
    file = io.BytesIO()
    Image.new("RGB", size, "#0a58ca").save(file, form)
    return file.getvalue()


def encoded(content: bytes) -> str:
    return base64.b64encode(content).decode()


def refused(**data: Any) -> str:
    with pytest.raises(ValidationError) as raised:
        PageSetupData.model_validate(data)
    return describe(raised.value)


def with_setup(project: Project, **data: Any) -> Project:
    project, item = edit.add_object(project, None, PAGE_SETUP.name)
    return edit.change_data(project, item.id, data)


@pytest.mark.parametrize(
    ("data", "said"),
    [
        ({"paper": "a2"}, "paper: Input should be 'a3', 'a4', 'a5', 'us-letter'"),
        ({"margins": {"top": 4.9}}, "margins.top: Input should be greater than or equal to 5"),
        ({"margins": {"left": 100.1}}, "margins.left: Input should be less than or equal to 100"),
        ({"margins": {"left": float("nan")}}, "margins.left: Input should be"),
        ({"margins": {"left": "20"}}, "margins.left: Input should be a valid number"),
        ({"margins": {"left": True}}, "margins.left: Input should be a valid number"),
        (
            {"paper": "a5", "margins": {"left": 45, "right": 44}},
            "the margins left and right leave 59 mm of 148 mm to the text, which needs 60 mm: "
            "together they may have 88 mm",
        ),
        (
            {"paper": "a5", "orientation": "landscape", "margins": {"top": 100, "bottom": 100}},
            "the margins top and bottom leave 0 mm of 148 mm",
        ),
        ({"title_page": 1}, "title_page: Input should be a valid boolean"),
        ({"author": "x" * 201}, "author: a text on pages has at most 200 characters, not 201"),
        ({"company": "a\nb"}, "company: a text on pages is one line"),
        (
            {"header": {"left": "{pages"}},
            "header.left: '{pages' is not closed; a brace itself is written twice, placeholders",
        ),
        (
            {"footer": {"right": "{Page}"}},
            "footer.right: '{Page}' is no placeholder; placeholders are {project}",
        ),
        ({"header": {"middle": "x"}}, "header.middle: Extra inputs are not permitted"),
        ({"logo": "@@"}, "logo: the picture is no base64"),
        ({"logo": "iVBO\nRw=="}, "logo: the picture is no base64 without line breaks"),
        ({"logo": ""}, "logo: the picture is neither PNG nor JPEG: convert it"),
        ({"logo": encoded(b"<svg xmlns=''/>")}, "neither PNG nor JPEG but SVG, which can hold scripts"),
        ({"logo": encoded(b'\n <?xml version="1.0"?><svg/>')}, "but SVG"),
        ({"logo": encoded(picture("GIF"))}, "neither PNG nor JPEG but GIF: convert it"),
        ({"logo": encoded(picture()[:60])}, "begins like a PNG but cannot be decoded: it is damaged"),
        ({"logo": encoded(picture("JPEG")[:-40])}, "begins like a JPEG but cannot be decoded"),
        (
            {"logo": encoded(picture(size=(4001, 1)))},
            "the picture has more than 4,000 pixels a side: make it smaller",
        ),
        (
            {"logo": encoded(picture() + bytes(256 * 1024))},
            "the picture has more than 262,144 bytes (256 KiB)",
        ),
    ],
)
def test_what_is_refused_and_why(data: dict[str, Any], said: str) -> None:
    assert said in refused(**data)


def test_all_placeholders_are_named() -> None:
    said = refused(header={"left": "{x}"})
    for name in PLACEHOLDERS:
        assert f"{{{name}}}" in said


@pytest.mark.parametrize("form", ["PNG", "JPEG"])
def test_a_logo_of_the_greatest_size(form: str) -> None:
    text = encoded(picture(form, (4000, 4000)))
    assert PageSetupData(logo=text).logo == text
    found = read_picture(text)
    assert (found.width, found.height, found.media_type) == (4000, 4000, f"image/{form.lower()}")


def test_a_picture_that_would_need_gigabytes_is_refused_before_it_is_decoded() -> None:
    """The size stands in the first block, before what is compressed."""
    content = bytearray(picture())
    content[16:24] = (100_000).to_bytes(4, "big") * 2
    content[29:33] = zlib.crc32(content[12:29]).to_bytes(4, "big")
    assert "more than 4,000 pixels a side" in refused(logo=encoded(bytes(content)))


PNG, JPEG = picture(), picture("JPEG")


@st.composite
def damaged(draw: st.DrawFn) -> bytes:
    """A picture with some bytes changed, cut off or put in."""
    content = bytearray(draw(st.sampled_from([PNG, JPEG])))
    for _ in range(draw(st.integers(1, 8))):
        at = draw(st.integers(0, len(content)))
        content[at : at + draw(st.integers(0, 4))] = draw(st.binary(max_size=4))
    return bytes(content)


@given(
    st.one_of(damaged(), st.binary(max_size=200), st.binary(max_size=200).map(lambda rest: PNG[:8] + rest))
)
@example(b"\xff\xd8\xff")
@example(PNG[:8])
def test_any_bytes_are_a_picture_or_refused(content: bytes) -> None:
    text = encoded(content)
    said = ""
    try:
        PageSetupData(logo=text)
    except ValidationError as error:
        said = describe(error)
    assert said.startswith("logo: the picture") or 1 <= read_picture(text).width <= 4000


@given(st.text(max_size=40))
@example("=\ud800")
@example("é")
def test_any_text_is_a_logo_or_refused(text: str) -> None:
    with pytest.raises(ValidationError):
        PageSetupData(logo=text)


def test_pieces_of_a_text() -> None:
    assert pieces_of("a {{b} {page}/{pages}}{{{object}") == (
        Piece("", "a {b} "),
        Piece("page"),
        Piece("", "/"),
        Piece("pages"),
        Piece("", "}{"),
        Piece("object"),
    )
    assert pieces_of("") == ()


@given(st.text(st.sampled_from("{}pageobject x"), max_size=30))
def test_any_text_has_pieces_or_a_reason(text: str) -> None:
    said = again = ""
    try:
        for piece in pieces_of(text):
            again += f"{{{piece.placeholder}}}" if piece.placeholder else piece.text.replace("{", "{{")
    except ValueError as error:
        said = str(error)
    assert again == text or "placeholders are {project}" in said


def test_a_project_has_one_at_its_root() -> None:
    project = with_setup(new_project("Press"))
    with pytest.raises(NotPlaceableError, match="has a page setup already"):
        edit.add_object(project, None, PAGE_SETUP.name)
    (application,) = project.applications()
    with pytest.raises(NotPlaceableError, match="belongs below the POUs view"):
        edit.add_object(project, application.id, PAGE_SETUP.name)
    with pytest.raises(InvalidDataError, match=r"page_setup 'Page Setup': margins\.top"):
        edit.change_data(project, project.find_kind(PAGE_SETUP.name)[0].id, {"margins": {"top": 1}})


def test_a_folder_keeps_it() -> None:
    project = with_setup(
        new_project("Press"),
        paper="a3",
        margins={"left": 25.5},
        logo=encoded(PNG),
        header={"centre": "{object}"},
    )
    again = folder.decode(folder.encode(project)).project
    (item,) = again.find_kind(PAGE_SETUP.name)
    assert item.data == project.find_kind(PAGE_SETUP.name)[0].data
    assert "Page Setup.page_setup.json" in " ".join(folder.encode(project))


def test_a_comparison_names_what_differs() -> None:
    old = with_setup(new_project("Press"), paper="a3")
    (item,) = old.find_kind(PAGE_SETUP.name)
    new = edit.change_data(old, item.id, {"paper": "a4", "orientation": "landscape"})
    found = Comparison(old, new).differences
    assert [(one.state, one.fields) for one in found.values()] == [("changed", ("paper", "orientation"))]


def test_the_front_end_knows_the_same_papers_and_placeholders() -> None:
    source = (ROOT / "frontend/src/kinds/page_setup/model.ts").read_text(encoding="utf-8")
    sheets = re.findall(r"^  '?([a-z0-9-]+)'?: \[([\d.]+), ([\d.]+)\],$", source, re.MULTILINE)
    assert {name: (float(width), float(height)) for name, width, height in sheets} == PAPERS
    names = source.partition("PLACEHOLDERS = [")[2].partition("]")[0]
    assert tuple(re.findall(r"'(\w+)'", names)) == PLACEHOLDERS
