"""Every sentence that can reach a user is there in Chinese, with its facts as they are."""

from __future__ import annotations

import re
import time
from functools import cache
from itertools import count

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from tappet.project.kind_registry import kinds
from tappet.project.placement import words_of
from tappet.translation.language import accepted, language_of
from tappet.translation.sentences import OPTIONAL, SPOKEN, WORDS, rows, sentence, table
from tappet.translation.templates import FIELD, Templates, filled

from .said_in_code import PLACE, templates, texts

PARTS = (
    "project", "motion", "server", "runtime", "traces", "documentation", "libraries",
    "cnc", "codegen/faults.py", "codegen/generate.py", "codegen/literals.py", "codegen/online.py",
    "codegen/symbol_map.py", "codegen/values.py", "codegen/expressions/compiler.py",
    "codegen/expressions/operators.py", "codegen/expressions/places.py", "disk_full.py", "iec/listing.py",
)  # fmt: skip
FILES_FOR_OTHERS = {
    "documentation/html.py": "markup",
    "documentation/page_css.py": "markup",
    "documentation/typesetting.py": "the log of the server",
    "documentation/words.py": "has its own Chinese words",
    "libraries/missing.py": "messages of the compiler: phrases_zh.csv",
    "libraries/parameters.py": "messages of the compiler: phrases_zh.csv",
    "motion/cam_program.py": "our own mistakes",
    "motion/path_program_text.py": "a program",
    "project/exchange/plcopen_type_xml.py": "markup",
    "project/exchange/plcopen_write.py": "markup",
    "project/exchange/xml_lines.py": "markup",
    "project/kind_registry.py": "authors of plug-ins",
    "project/kinds/dut.py": "declarations",
    "project/kinds/gvl.py": "declarations",
    "project/kinds/script.py": "the text of a new script",
    "project/recipes/code.py": "declarations",
    "runtime/__main__.py": "the command line",
    "runtime/executive/records.py": "our own mistakes",
    "runtime/link.py": "a damaged package, which no build makes",
    "runtime/operations/declaration.py": "authors of plug-ins",
    "runtime/operations/registry.py": "authors of plug-ins",
    "runtime/posix.py": "the host of the runtime",
    "runtime/protocol.py": "other clients of the wire",
    "runtime/unit_tests/junit.py": "a file format",
    "server/app.py": "the API document",
    "server/audit_reserve.py": "the log of the server and the audit log",
    "server/docs/page.py": "the API document",
    "server/dap/connection.py": "other editors that break the protocol",
    "server/dap/messages.py": "other editors that break the protocol",
    "server/dap/stdio.py": "the command line",
    "server/framed_messages.py": "other editors that break the protocol",
    "server/lsp/rpc.py": "other editors that break the protocol",
    "server/lsp/stdio.py": "the command line",
    "server/metrics/service.py": "Prometheus",
    "server/openapi.py": "the API document",
    "server/persistent/service.py": "declarations",
    "server/serve.py": "the command line",
    "server/static.py": "a server without a front end",
}  # fmt: skip
FOR_OTHERS = {
    # the command line and the log of the server
    "'\N{REPLACEMENT CHARACTER}' is no database of the store; use sqlite:///file or postgresql://...",
    "The address of the database is no URL; use sqlite:///file or postgresql://user@host/name",
    "The database was written by a newer version of Tappet; start that version, or restore a backup made "
    f"with this one ({PLACE})",
    "Can't locate revision", "nothing imported",
    f"the import ended with exit code {PLACE}; its error is above",
    f"the path of the folder for temporary files is too long: {PLACE}",
    f"{PLACE} holds more than {PLACE} .st files; open the project's own folder",
    f"the flight recorder needs at least {PLACE} bytes, at most 16 GiB; 0: off",
    "the flight recorder keeps more than 0 and at most 86,400 seconds",
    f"divider at least 1, scan limit at least {PLACE} bytes",
    # Python programs and other editors
    "give either cycles or time_ns", "the application is stopped; start it before running",
    "Give 'name', or 'textDocument' and 'position'", f"'{PLACE}' before 'initialize' or after 'shutdown'",
    "messages are text", "unknown host", f"expected hello: {PLACE}", "taking over", "shut down",
    # the audit log, history, names of things
    "local link", "first account", "the password of no account", f"Example from {PLACE}",
    f"revision {PLACE}", "flight recorder", "What to do", f"image offset {PLACE}", f"offset {PLACE}",
    "online change", "not created", f"{PLACE}, line {PLACE}", "machine code", f"{PLACE} of {PLACE}",
    # damage that no build and no runtime makes
    f"type index {PLACE} is out of range: there are {PLACE} types",
    f"{PLACE} bytes are no entries of {PLACE} bytes each",
    f"a run of {PLACE} bytes for offset {PLACE} in {PLACE} bytes",
    f"a run of {PLACE} bytes for offset {PLACE}, image of {PLACE} bytes",
    f"a frame of {PLACE} bytes: the stream is broken",
    # a pragma whose message is in phrases_zh.csv
    f"{{error 'The body of {PLACE} is in {PLACE}, which cannot be compiled yet; it was imported and is kept "
    "unchanged; write it in ST to run it'}",
    f"The application has no cyclic task that could move the axis {PLACE}; add a cyclic task",
    f"The bus task {PLACE} of the axis {PLACE} does not exist; choose another bus task",
    f"The bus task {PLACE} of the axis {PLACE} is not cyclic; set values are computed for a fixed time, "
    "so choose a cyclic task",
    f"{{error '{PLACE}'}}", f"{{{PLACE} cnc '{PLACE}'}}", "{error cnc ",
    f"{{{PLACE} cam '{PLACE}: {PLACE}'}}",
    # halves of sentences that are in the table as wholes
    "placeholders are ", "data breakpoint",
    "; look-around and back references cannot be searched for", "invalid perl operator",
    "invalid escape sequence", "Value error, ", f"{PLACE} became {PLACE}", f"the {PLACE} '{PLACE}'",
    f"The runtime '{PLACE}' is not connected since {PLACE} UTC", f"image offset {PLACE}.{PLACE}",
    "; the system does so when memory runs out", "; the C library does so when memory of __NEW is damaged",
    "; memory beside that of __NEW was overwritten, or __DELETE got what is not from __NEW",
    f"; the last one that ran was {PLACE}.{PLACE}", f"; the last suite was {PLACE}",
    f"; the memory for tests is used up ({PLACE} MiB)", f"; the memory of __NEW is used up ({PLACE} MiB)",
}  # fmt: skip
"""Texts that no user of the workbench reads, or that are parts of others."""
CODE = (
    "default-src",
    "{attribute '",
    "{{attribute '",
    "    {attribute '",
    "IF xStop",
    "{IF defined",
    "hastype (",
    "(byLetter := ",
    f"{PLACE}\nVAR_GLOBAL",
    f"{PLACE} : {PLACE}.SMC_",
    f"    {PLACE}_A : ARRAY[",
    f"{PLACE}\n{{attribute",
    "\n{drive}(",
    "PROGRAM PLC_PRG",
    "// ",
)
"""Begins of texts that are no sentences."""
TWO_WORDS = re.compile(r"[a-z]{2,} [a-z]{2,}")
QUOTED = re.compile("“[^”]*”|`[^`]*`|“?Authorization: Bearer <token>”?")


@cache
def said() -> dict[str, str]:
    """Templates that users may read, each with a place where it stands."""
    found: dict[str, str] = {}
    for part in PARTS:
        for one in templates(part):
            if (
                one.where.partition(":")[0] not in FILES_FOR_OTHERS
                and one.template not in FOR_OTHERS
                and not one.template.startswith(CODE)
            ):
                found.setdefault(one.template, one.where)
    return found


def an_example(template: str) -> str:
    number = count(1)
    return re.sub(PLACE, lambda _: f"Q{next(number)}Z", template)


def test_every_sentence_has_a_chinese_one() -> None:
    assert len(said()) > 450
    wrong = []
    for template, where in said().items():
        english = an_example(template)
        chinese = sentence(english, "zh")
        facts = re.findall(r"Q\d+Z", english)
        if (
            chinese == english
            or TWO_WORDS.search(QUOTED.sub("", chinese))
            or any(fact not in chinese for fact in facts)
        ):
            wrong.append(f"{where}: {english!r}: {chinese!r}")
    assert wrong == [], "\n".join(wrong)


def test_what_is_left_out_is_there() -> None:
    everything = {one.template for part in PARTS for one in templates(part)}
    assert FOR_OTHERS - everything == set()
    files = {one.where.partition(":")[0] for part in PARTS for one in templates(part)}
    assert FILES_FOR_OTHERS.keys() - files == set()


def test_rows_are_well_formed() -> None:
    known = rows("zh")
    assert len(known) > 500
    assert len({english for english, _ in known}) == len(known), "a sentence is there twice"
    for english, chinese in known:
        assert set(FIELD.findall(english)) == set(FIELD.findall(chinese)), english
        assert len(FIELD.findall(english)) == len(set(FIELD.findall(english))), english
        assert "}{" not in english, f"{english}: where does one fact end?"


def test_every_row_is_used() -> None:
    """Its words are in the code; names of kinds, HTTP phrases, messages of libraries come from elsewhere."""
    others = ("expat", "frames", "http", "regular_expressions", "validation", "words")
    elsewhere = {english for name in others for english, _ in table("zh", name)}
    code = "\n".join(text for part in (*PARTS, "codegen/package.py") for text in texts(part))
    examples = [an_example(one.template) for part in PARTS for one in templates(part)]
    unused = []
    for english, _ in rows("zh"):
        pieces = [
            piece.strip(" ;:,.'()`").replace("{{", "{").replace("}}", "}")
            for piece in FIELD.split(english)[::2]
        ]
        pattern = re.compile(".*?".join(map(re.escape, FIELD.split(english)[::2])), re.DOTALL)
        if (
            english not in elsewhere
            and not all(piece in code for piece in pieces)
            and not any(map(pattern.fullmatch, examples))
        ):
            unused.append(english)
    assert unused == [], "\n".join(unused)


NAMES = st.text(
    st.characters(exclude_categories=["Cs"], exclude_characters="\0") | st.sampled_from("'{}“”；：$\\()[]"),
    min_size=1,
    max_size=30,
)


@pytest.mark.parametrize("english", [english for english, _ in rows("zh") if FIELD.search(english)])
def test_a_row_is_found_for_its_own_sentences(english: str) -> None:
    fields = FIELD.findall(english)
    facts = {name: f"Q{number}Z" for number, name in enumerate(fields)}
    spoken = {name: "division by zero" if name in SPOKEN else fact for name, fact in facts.items()}
    chinese = sentence(filled(english, spoken), "zh")
    assert "division by zero" not in chinese
    assert all(spoken[name] in chinese for name in fields if name not in SPOKEN)
    assert re.search("[一-鿿]", chinese)


@given(st.sampled_from([row for row in rows("zh") if len(FIELD.findall(row[0])) == 1]), NAMES)
def test_names_with_odd_characters_come_back_as_they_are(row: tuple[str, str], name: str) -> None:
    english, chinese = row
    (field,) = FIELD.findall(english)
    assume(field not in SPOKEN and field not in WORDS)
    said = sentence(filled(english, {field: name}), "zh")
    assume(said not in (translation for _, translation in rows("zh")))
    assert name in said or said == filled(english, {field: name})
    if not re.search(r"[A-Za-z]{2}", name):  # such a name may make the sentence one of another row
        assert said == filled(chinese, {field: name})


def test_the_longest_literal_text_comes_first() -> None:
    table = Templates([("{a} is gone", "1 {a}"), ("'{a}' is gone", "2 {a}"), ("it is gone", "3")])
    assert table.find("'x' is gone", lambda _, fact: fact) == "2 x"
    assert table.find("x is gone", lambda _, fact: fact) == "1 x"
    assert table.find("it is gone", lambda _, fact: fact) == "3"
    assert table.find("it is here", lambda _, fact: fact) is None


def test_sentences_inside_sentences() -> None:
    assert sentence("'Line 1' refused: the package was refused: not a Tappet code package", "zh") == (
        "“Line 1”拒绝执行：程序包被拒绝：不是 Tappet 程序包"
    )
    assert sentence("Cut.st:3: END_IF is missing; the object ends with the file", "zh") == (
        "Cut.st:3：缺少 END_IF；对象在文件末尾结束"
    )
    assert sentence(
        "A task cannot be below the folder 'task'; it belongs below task configuration", "zh"
    ) == ("任务不能放在文件夹“task”之下；它应在任务配置之下")


def test_a_text_that_is_not_ours_stays() -> None:
    for text in ("", "Nobody has said this.", "this and that", "a: b", "x or y", "a" * 20_000):
        assert sentence(text, "zh") == text
    assert sentence("There is nothing to undo", "en") == "There is nothing to undo"


def test_a_long_fact_takes_no_longer() -> None:
    begun = time.process_time()
    sentence("'" * 9_000, "zh")
    sentence("'a' (b) has no member 'c" * 400, "zh")
    assert time.process_time() - begun < 2


def test_kinds_of_objects_have_words() -> None:
    names = [kind.words for kind in kinds().values()] + [
        words_of(sub) for kind in kinds().values() for sub in kind.templates
    ]
    english = {english for english, _ in rows("zh")}
    assert {name for name in names if name.isascii() and name not in english} == set()


@pytest.mark.parametrize(
    ("header", "language"),
    [
        (None, "en"), ("", "en"), ("zh", "zh"), ("zh-CN,zh;q=0.9,en;q=0.8", "zh"), ("en-GB,zh;q=0.5", "en"),
        ("de,zh;q=0.3", "zh"), ("zh;q=0", "en"), ("zh;q=x, en;q=0.1", "en"), ("*", "en"), ("ZH-hant", "zh"),
    ],
)  # fmt: skip
def test_accept_language(header: str | None, language: str) -> None:
    assert accepted(header) == language


def test_tags() -> None:
    assert [language_of(tag) for tag in ("zh-TW", "en", "", None, "de")] == ["zh", "en", "en", "en", "en"]
    assert SPOKEN >= OPTIONAL
