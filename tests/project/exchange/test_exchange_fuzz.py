"""Whatever bytes come in, the answer is a report or one error that names the file; and it comes soon."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tappet.project.exchange.importing import import_files
from tappet.project.exchange.report import ExchangeError
from tappet.project.exchange.xml_tree import Element, read_xml, xml_text
from tappet.project.placement import check_project

SAMPLES = Path(__file__).parent / "samples"
SAMPLE_FILES = sorted(p for p in SAMPLES.rglob("*") if p.is_file())


def survives(files: dict[str, bytes]) -> None:
    """Import; either it works and gives a sound project, or the error names one of the files."""
    error = None
    try:
        done = import_files(files)
    except ExchangeError as raised:
        error = raised
    if error is not None:
        assert error.source in files, str(error)
        assert str(error).startswith(error.source)
    else:
        check_project(done.project)
        assert all(entry.source in files for entry in done.report.entries)


@settings(max_examples=150, deadline=None)
@given(st.data())
def test_damaged_samples(data: st.DataObject) -> None:
    path = data.draw(st.sampled_from(SAMPLE_FILES))
    content = bytearray(path.read_bytes())
    for _ in range(data.draw(st.integers(1, 4))):
        start = data.draw(st.integers(0, len(content)))
        stop = min(len(content), start + data.draw(st.integers(0, 60)))
        put = data.draw(
            st.binary(max_size=8)
            | st.sampled_from(
                [b"(*", b"*)", b"'", b"END_VAR", b"METHOD x", b"TYPE", b"<a>", b"</a>", b'"', b"{"]
            )
            | st.just(bytes(content[start:stop]) * 2)
        )
        content[start:stop] = put
    survives({path.name: bytes(content)})


@settings(max_examples=60, deadline=None)
@given(st.sampled_from(SAMPLE_FILES), st.integers(0, 100))
def test_truncated_samples(path: Path, percent: int) -> None:
    content = path.read_bytes()
    survives({path.name: content[: len(content) * percent // 100]})


@settings(max_examples=40, deadline=None)
@given(
    st.sampled_from(
        [
            "x.xml",
            "x.st",
            "x.exp",
            "x.TcPOU",
            "x.plcproj",
            "x.TcTTO",
            "x.tsproj",
            "x.sln",
            "x.xti",
            "x.export",
            "x.bin",
        ]
    ),
    st.binary(max_size=300),
)
def test_any_bytes(name: str, content: bytes) -> None:
    survives({name: content})


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "utf-16-le", "utf-16-be", "cp1252"])
@pytest.mark.parametrize("name", ["x.st", "x.xml"])
def test_encodings(encoding: str, name: str) -> None:
    text = "PROGRAM P\nVAR\n  n : INT; // Größe in °C\nEND_VAR\nn := 1;\nEND_PROGRAM\n"
    if name == "x.xml":
        declared = "windows-1252" if encoding == "cp1252" else "utf-8"
        text = (
            f'<?xml version="1.0" encoding="{declared}"?>'
            '<project><types><pous><pou name="P" pouType="program">'
            "<interface><localVars><variable name='n'><type><INT/></type><documentation>Größe in °C"
            "</documentation></variable></localVars></interface></pou></pous></types></project>"
        )
    project = import_files({name: text.encode(encoding)}).project
    (program,) = project.find_kind("pou")
    assert "Größe in °C" in program.data.model_dump()["declaration"]


@pytest.mark.parametrize(
    ("content", "line", "says"),
    [
        (b"<project>\n<types>\n</project>", 3, "mismatched tag"),
        (b"", 1, "no element found"),
        (b"<html/>", 1, "its root is <html>"),
        (b"<a>" * 100_000, 1, "nested deeper"),
        (b'<!DOCTYPE a [<!ENTITY b "c"><!ENTITY d "&b;&b;">]><project>&d;</project>', 1, "document type"),
        (b'<!DOCTYPE a SYSTEM "file:///etc/passwd"><project/>', 1, "document type"),
        ("\ufeff<project>".encode("utf-16-le") + b"\x00\xd8", 1, "UTF-16-LE"),
        (b'<?xml version="1.0"?>\n<project>&nbsp;</project>', 2, "undefined entity"),
    ],
)
def test_hostile_xml_gives_one_error_with_its_line(content: bytes, line: int, says: str) -> None:
    with pytest.raises(ExchangeError) as caught:
        import_files({"dir/x.xml": content})
    assert caught.value.line == line
    assert says in str(caught.value)
    assert str(caught.value).startswith(f"dir/x.xml:{line}: ")


def test_huge_attributes_and_names_are_taken_or_refused_with_a_reason() -> None:
    long = "x" * 1_000_000
    content = (
        f'<project><types><pous><pou name="{long}" pouType="program"/></pous></types></project>'.encode()
    )
    done = import_files({"x.xml": content})
    assert [entry.outcome for entry in done.report.entries] == ["refused"]
    assert len(done.report.entries[0].text) < 300


def test_a_structure_that_nests_objects_in_themselves_does_no_harm() -> None:
    one, two = "11111111-0000-4000-8000-000000000001", "11111111-0000-4000-8000-000000000002"
    method = f'<data name="m/method"><Method name="M" ObjectId="{two}"><interface/></Method></data>'
    content = (
        '<project><types><pous><pou name="F" pouType="functionBlock"><interface/><addData>'
        f'{method}<data name="o/objectid"><ObjectId>{one}</ObjectId></data></addData></pou></pous></types>'
        '<addData><data name="p/projectstructure"><ProjectStructure>'
        f'<Object Name="M" ObjectId="{two}"><Object Name="F" ObjectId="{one}"/></Object>'
        "</ProjectStructure></data></addData></project>"
    )
    project = import_files({"x.xml": content.encode()}).project
    assert [item.name for item in project.walk() if item.kind in ("pou", "method")] == ["F", "M"]


NAMES = st.sampled_from(["a", "b", "LD", "xhtml"])
SPACES = st.sampled_from(["", "http://www.w3.org/1999/xhtml", "urn:x"])
TEXTS = st.text(st.characters(exclude_categories=["Cs", "Cc"]) | st.sampled_from("\n\t<&>\"' "), max_size=8)


@st.composite
def elements(draw: st.DrawFn, depth: int = 3) -> Element:
    content: list[Element | str] = []
    for _ in range(draw(st.integers(0, 3 if depth else 0))):
        part = draw(TEXTS.filter(bool) | st.just("element"))
        if part != "element":
            if content and isinstance(content[-1], str):
                continue
            content.append(part)
        else:
            content.append(draw(elements(depth - 1)))
    keys = st.sampled_from(["n", "{urn:y}n", "{http://www.w3.org/2001/XMLSchema-instance}type"])
    return Element(draw(NAMES), draw(SPACES), draw(st.dictionaries(keys, TEXTS, max_size=2)), content)


@settings(max_examples=100, deadline=None)
@given(elements())
def test_kept_xml_reads_back_as_the_same_tree(root: Element) -> None:
    def plain(item: Element | str) -> object:
        if isinstance(item, str):
            return item
        return item.tag, item.namespace, item.attributes, [plain(part) for part in item.content]

    written = xml_text(root)
    again = read_xml("x", written.encode())
    assert plain(again) == plain(root)
    assert xml_text(again) == written
