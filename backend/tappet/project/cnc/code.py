"""The ST that is made of CNC programs: global variables of their names, and their registration (cnc.md 12).

A program that is compiled as words is complete here. One that is compiled as queue of path objects holds its
order for the blocks of the library, which fill the queue when the application is built: `queue_order`.
"""

from __future__ import annotations

import hashlib
import zlib
from base64 import b64decode, b64encode
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from tappet.cnc.checks import check
from tappet.cnc.parser import parse, read_lines
from tappet.cnc.word_list import CodeWord, code_words, default_words, packed, real_text
from tappet.cnc.words import Line, Problem, Program
from tappet.project.axes.variables import NOT_WRITTEN_BY_HAND
from tappet.project.cnc.program import CncPosition, CncProgramData
from tappet.project.cnc.settings import CncSettingsData
from tappet.project.model import ProjectObject
from tappet.project.source_text import SourceWriter

LIBRARY = "SM3_CNC"
VARIABLES = "IoConfig_{name}"
"""The list of global variables that a program is; each has its own: an online change moves no other one."""
LIST_VARIABLES = "IoConfig_CncList"
SETTINGS_VARIABLES = "IoConfig_CncSettings"
PROGRAM_ORDER, SETTINGS_ORDER = "cnc_program", "cnc_settings"
"""Attributes that hold data for the compiler, compressed and in base 64."""
FINDINGS = "SM3_{name}_Findings"
"""A function that is never called; what is wrong with the program stands in it."""
MOST_MESSAGES = 200
"""Of one program; the first ones say enough."""
_LONGEST_NAME = 80
_MEMBERS = dict(
    zip(
        CncPosition.model_fields,
        ("dX", "dY", "dZ", "dA", "dB", "dC", *(f"dA{n}" for n in range(1, 6))),
        strict=True,
    )
)
_NUMBERS = "INT BYTE WORD DINT DWORD REAL SINT USINT UINT UDINT LREAL"


def write_program(item: ProjectObject, writer: SourceWriter) -> None:
    """The variables of a program, and what is wrong with it."""
    data = item.data_as(CncProgramData)
    writer.name = VARIABLES.format(name=item.name)
    writer.keyword(f"{NOT_WRITTEN_BY_HAND}\nVAR_GLOBAL")
    if data.compile_mode == "file":
        writer.keyword("END_VAR")
        _write_findings(item, [Problem(0, 0, 0, _FILE_MODE)], [], writer)
        return
    program = parse(data.implementation)
    problems = check(program.lines)
    words = used_words(data, program)
    variables = [(line, word) for line, word in words if word.variable is not None]
    if data.compile_mode == "out_queue":
        problems += [Problem(*_place(line, word), _in_queue(word), "warning") for line, word in variables]
        writer.part(item.id, "declaration", _queue(item.name, data))
        variables = []
    else:
        _write_words(item, data, program, words, variables, writer)
    writer.keyword("END_VAR")
    _write_findings(item, problems, variables, writer)


def write_list(items: Sequence[ProjectObject], writer: SourceWriter) -> None:
    """Registers all programs before the first cycle, and again with an online change of one (DAT-02)."""
    writer.name = LIST_VARIABLES
    lines, state = [], hashlib.blake2s(digest_size=8)
    for item in items:
        data = item.data_as(CncProgramData)
        manager = {"cnc_ref": "g_CNCProgManager", "out_queue": "g_CNCQueueManager"}.get(data.compile_mode)
        state.update(f"{item.name} {data.model_dump_json()}".encode())
        if manager is not None:
            lines.append(f"{LIBRARY}.{manager}.Register(ADR({item.name}));")
    body = "\n".join(lines)
    writer.keyword(f"""{NOT_WRITTEN_BY_HAND}
VAR_GLOBAL
    {{attribute 'init_on_onlchange' := '{state.hexdigest()}'}}
    SM3_CncListed : BOOL := SM3_RegisterCnc();
END_VAR
{{attribute 'hide'}}
FUNCTION SM3_RegisterCnc : BOOL
{LIBRARY}.g_CNCProgManager.Clear();
{LIBRARY}.g_CNCQueueManager.Clear();
{body}
SM3_RegisterCnc := TRUE;
END_FUNCTION""")


def write_settings(settings: CncSettingsData, writer: SourceWriter) -> None:
    """What the compiler needs to know of the settings: the preprocessing."""
    writer.name = SETTINGS_VARIABLES
    writer.keyword(f"{{attribute '{SETTINGS_ORDER}' := '{packed_text(settings.model_dump_json())}'}}")
    writer.keyword("VAR_GLOBAL\nEND_VAR")


def packed_text(text: str) -> str:
    """A text as the value of an attribute."""
    return packed_bytes(text.encode())


def packed_bytes(data: bytes) -> str:
    """Data as the value of an attribute."""
    return b64encode(zlib.compress(data, 6)).decode()


@dataclass(frozen=True, slots=True)
class QueueOrder:
    """A program that is compiled as queue of path objects, as it stands in its text."""

    name: str
    data: CncProgramData
    line: int
    """Of the text, from 0: the order, then the objects, then the queue."""


def queue_order(text: str) -> QueueOrder | None:
    """The order that the text of a program holds; None for any other text."""
    for number, line in enumerate(text.split("\n", 6)[:6]):
        packed_order = attribute_in(line, PROGRAM_ORDER)
        if packed_order is not None:
            name = text.split("\n", number + 3)[number + 2].split(":", 1)[0].strip()
            return QueueOrder(name, CncProgramData.model_validate_json(packed_order), number)
    return None


def attribute_in(line: str, name: str) -> bytes | None:
    """The data behind an attribute that is a line of its own."""
    start = f"{{attribute '{name}' := '"
    line = line.strip()
    return (
        zlib.decompress(b64decode(line[len(start) :].partition("'")[0])) if line.startswith(start) else None
    )


def queue_lines(order: QueueOrder, objects: bytes, count: int, size: int) -> list[str]:
    """The three lines of a queue of `count` objects of `size` bytes in place of its order."""
    capacity = count + QUEUE_ROOM
    data = packed_bytes(objects + bytes(QUEUE_ROOM * size))
    variable = queue_variable(order.name, order.data, count)
    state = hashlib.blake2s(objects + variable.encode(), digest_size=8).hexdigest()
    mark = f"{{attribute 'init_on_onlchange' := '{state}'}}"
    return [
        f"    {mark} {{attribute 'initial_bytes' := '{data}'}}",
        f"    {order.name}_A : ARRAY[0..{capacity - 1}] OF {LIBRARY}.SMC_GEOINFO;",
        f"    {mark} {variable}",
    ]


QUEUE_ROOM = 5
"""Objects more than there are: a queue is full with three left, and has room for five at least."""
EDITOR = 255
"""byGenerator (DAT-03)."""
_FILE_MODE = (
    "The compile mode File is not supported; choose SMC_CNC_REF or SMC_OUTQUEUE, or exclude the program "
    "from the build and put its file into the controller"
)


def program_name(name: str, text: str) -> str:
    """What strProgramName is: the header line of a text, or the name of the object."""
    header = next(
        (line.header for line in read_lines(text.split("\n", 100)[:100]) if line.header is not None), ""
    )
    return (header or name)[:_LONGEST_NAME]


def reference_variable(name: str, data: CncProgramData, words: int) -> str:
    """The declaration of a program of words."""
    start = ", ".join(
        f"{member} := {real_text(getattr(data.start, axis))}" for axis, member in _MEMBERS.items()
    )
    title = _string(program_name(name, data.implementation))
    return (
        f"{name} : {LIBRARY}.SMC_CNC_REF := (nElements := {words}, pgc := ADR({name}_A), "
        f"piStartPosition := ({start}), strProgramName := {title});"
    )


def queue_variable(name: str, data: CncProgramData, objects: int) -> str:
    """The declaration of a queue of path objects; it has room for some more."""
    title = _string(program_name(name, data.implementation))
    return (
        f"{name} : {LIBRARY}.SMC_OUTQUEUE := (pbyBuffer := ADR({name}_A), "
        f"nCapacity := {objects + QUEUE_ROOM}, nWritePos := {objects}, bEndOfList := TRUE, "
        f"byGenerator := {EDITOR}, nStored := {objects}, nChecked := {objects}, strProgramName := {title});"
    )


def used_words(data: CncProgramData, program: Program) -> list[tuple[Line | None, CodeWord]]:
    """The words of SMC_CNC_REF in their order, each with the line it comes from; the default dynamics of the
    properties stand in front."""
    found: list[tuple[Line | None, CodeWord]] = [
        (None, word) for word in default_words(data.velocity, data.acceleration, data.deceleration)
    ]
    for line in program.lines:
        if data.step_suppression and line.suppressed:
            continue
        found += [(line, word) for word in code_words([line])]
    return found


def _queue(name: str, data: CncProgramData) -> str:
    order = packed_text(data.model_dump_json())
    return (
        f"    {{attribute '{PROGRAM_ORDER}' := '{order}'}}\n"
        f"    {name}_A : ARRAY[0..0] OF {LIBRARY}.SMC_GEOINFO;\n"
        f"    {name} : {LIBRARY}.SMC_OUTQUEUE;"
    )


def _write_words(
    item: ProjectObject,
    data: CncProgramData,
    program: Program,
    words: Sequence[tuple[Line | None, CodeWord]],
    variables: Sequence[tuple[Line | None, CodeWord]],
    writer: SourceWriter,
) -> None:
    name = item.name
    content = packed((word for _, word in words), lambda word: (0, 0))
    state = hashlib.blake2s(content, digest_size=8)
    state.update(reference_variable(name, data, len(words)).encode())
    state.update(" ".join(word.variable or "" for _, word in variables).encode())
    mark = f"    {{attribute 'init_on_onlchange' := '{state.hexdigest()}'}}"
    writer.part(
        item.id,
        "declaration",
        f"{mark}\n    {{attribute 'initial_bytes' := '{packed_bytes(content)}'}}\n"
        f"    {name}_A : ARRAY[0..{len(words) - 1}] OF {LIBRARY}.SMC_GCODE_WORD;",
    )
    if variables:
        writer.keyword(f"{mark}\n    {name}_V : ARRAY[0..{len(variables) - 1}] OF POINTER TO BYTE := [")
        last = len(variables) - 1
        places = (number for number, (_, word) in enumerate(words) if word.variable is not None)
        for number, (place, (line, word)) in enumerate(zip(places, variables, strict=True)):
            call = f"{LIBRARY}.WordVariable(ADR({name}_A[{place}]), {word.variable})"
            writer.about(item.id, *_place(line, word), call + ("," if number < last else "];"))
    writer.part(item.id, "declaration", f"{mark}\n    {reference_variable(name, data, len(words))}")


def _write_findings(
    item: ProjectObject,
    problems: Sequence[Problem],
    variables: Sequence[tuple[Line | None, CodeWord]],
    writer: SourceWriter,
) -> None:
    """A function that holds what is wrong, each message at its line and word."""
    if not problems and not variables:
        return
    writer.keyword(f"{{attribute 'hide'}}\nFUNCTION {FINDINGS.format(name=item.name)} : BOOL")
    for problem in problems[:MOST_MESSAGES]:
        writer.about(item.id, problem.line, problem.column, problem.length, message_pragma(problem))
    for line, word in variables:
        writer.about(item.id, *_place(line, word), _type_check(word))
    writer.keyword(f"{FINDINGS.format(name=item.name)} := TRUE;\nEND_FUNCTION")


def message_pragma(problem: Problem) -> str:
    """A message as the compiler says it."""
    text = problem.message.replace("{", "(").replace("}", ")").replace("\n", " ")
    return f"{{{problem.severity} cnc '{text}'}}"


def _type_check(word: CodeWord) -> str:
    """Says that a variable has a type that a word cannot have; that there is none, its use says."""
    name = word.variable or ""
    if "[" in name:
        return ""
    types = "SMC_M_PARAMETERS" if word.letter == ord("O") else ""
    fits = " OR ".join(f"hastype (variable: {name}, {one})" for one in f"{_NUMBERS} {types}".split())
    problem = Problem(0, 0, 0, f"{name} is no variable of a number type; declare it for example as LREAL")
    return f"{{IF defined (variable: {name}) AND NOT ({fits})}}{message_pragma(problem)}{{END_IF}}"


def _place(line: Line | None, word: CodeWord) -> tuple[int, int, int]:
    """Line, column and length of a word with a variable."""
    assert line is not None
    found: Iterator[tuple[int, int, int]] = (
        (line.place, one.column, one.length) for one in line.words if one.variable == word.variable
    )
    return next(found)


def _in_queue(word: CodeWord) -> str:
    return (
        f"The path is made when the application is built, with the offline value of {word.variable}; "
        "choose SMC_CNC_REF for its value at run time"
    )


def _string(text: str) -> str:
    """A literal; what is not ASCII is written by its number in Latin 1, or as a question mark."""
    found = []
    for character in text:
        code = ord(character) if ord(character) < 256 else ord("?")
        plain = 32 <= code < 127 and character not in "$'{}"
        found.append(chr(code) if plain else f"${code:02X}")
    return f"'{''.join(found)}'"
