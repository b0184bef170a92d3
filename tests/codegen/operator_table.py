"""Every operator, conversion and statement over operands of every type, as statements of one program."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import product

from tappet.lang import ast
from tappet.lang.analysis.run import analyse
from tappet.lang.parser import parse
from tappet.lang.source import Source
from tappet.lang.walk import statements

_NAMES = """
BOOL BYTE WORD DWORD LWORD SINT INT DINT LINT USINT UINT UDINT ULINT REAL LREAL
TIME LTIME DATE LDATE TOD LTOD DT LDT STRING WSTRING
"""
ELEMENTARY = tuple(_NAMES.split())
GENERIC = ("ANY", "ANY_NUM", "ANY_INT", "ANY_REAL", "ANY_BIT", "ANY_STRING", "ANY_DATE")
DECLARED = {
    **{f"v{name}": name for name in ELEMENTARY},
    "vShort": "STRING(5)", "vLong": "STRING(300)", "vWideLong": "WSTRING(300)",
    "vPointer": "POINTER TO INT", "vTextPointer": "POINTER TO STRING", "vBlockPointer": "POINTER TO FB_Base",
    "vPointerPointer": "POINTER TO POINTER TO LREAL", "vBytes": "POINTER TO BYTE",
    "vReference": "REFERENCE TO INT", "vRealReference": "REFERENCE TO LREAL",
    "vTextReference": "REFERENCE TO STRING", "vStructReference": "REFERENCE TO ST_Data",
    "vBlockReference": "REFERENCE TO FB_Base", "vEnum": "E_Mode", "vStrictEnum": "E_Strict",
    "vEnumReference": "REFERENCE TO E_Mode", "vSubrange": "INT(-5..20)", "vUnsignedRange": "ULINT(0..20)",
    "vAlias": "T_Real", "vTextAlias": "T_Text", "vPointerAlias": "T_Pointer", "vArray": "ARRAY[0..3] OF INT",
    "vTexts": "ARRAY[0..1] OF STRING", "vMatrix": "ARRAY[0..1, 0..1] OF LREAL", "vStruct": "ST_Data",
    "vDerived": "ST_More", "vUnion": "U_Data", "vBlock": "FB_Base", "vDerivedBlock": "FB_More",
    "vInterface": "I_Base", "vOtherInterface": "I_Other", "vTimer": "TON",
}  # fmt: skip
"""Variables of every kind of type."""
TYPES = """
TYPE ST_Data : STRUCT n : INT; flag : BIT; other : BIT; x : LREAL; END_STRUCT END_TYPE
TYPE ST_More EXTENDS ST_Data : STRUCT y : INT; END_STRUCT END_TYPE
TYPE U_Data : UNION n : INT; x : LREAL; END_UNION END_TYPE
TYPE E_Mode : (eOff, eOn, eFault := 7) UINT; END_TYPE
{attribute 'strict'}
TYPE E_Strict : (eRed, eGreen); END_TYPE
TYPE T_Real : LREAL; END_TYPE
TYPE T_Text : STRING(20); END_TYPE
TYPE T_Pointer : POINTER TO LREAL; END_TYPE
INTERFACE I_Base
METHOD Run : INT END_METHOD
PROPERTY Level : LREAL GET END_GET END_PROPERTY
END_INTERFACE
INTERFACE I_Other EXTENDS __SYSTEM.IQueryInterface
END_INTERFACE
FUNCTION_BLOCK FB_Base IMPLEMENTS I_Base
VAR_INPUT in : INT; END_VAR
VAR_OUTPUT out : INT; END_VAR
METHOD Run : INT Run := in; END_METHOD
PROPERTY Level : LREAL GET Level := in; END_GET SET in := LREAL_TO_INT(Level); END_SET END_PROPERTY
PROPERTY Text : STRING GET Text := 'a'; END_GET END_PROPERTY
END_FUNCTION_BLOCK
FUNCTION_BLOCK FB_More EXTENDS FB_Base
END_FUNCTION_BLOCK
FUNCTION Count : INT
VAR_INPUT n : INT; END_VAR
Count := n;
END_FUNCTION
FUNCTION Open : INT
VAR_IN_OUT a : ARRAY[*] OF INT; END_VAR
VAR_INPUT x : ANY; END_VAR
Open := DINT_TO_INT(LOWER_BOUND(a, 1));
END_FUNCTION
"""
OTHERS = (
    "1", "0", "-1", "300", "1.5", "TRUE", "'a'", '"a"', "''", "T#1s", "LT#1s", "D#2000-01-01", "TOD#1:00",
    "DT#2000-01-01-1:00", "INT#5", "16#FFFFFFFFFFFFFFFF", "LREAL#2.0", "STRING#'b'", "E_Mode.eOn", "eOff",
    "E_Strict.eRed", "vStruct.flag", "vStruct.x", "vINT.3", "vArray[1]", "vPointer^", "vBlockPointer^.out",
    "vStructReference.n", "vBlock.Level", "vBlock.Text", "vInterface.Level", "vInterface.Run()",
    "vBlock.Run()", "Count(3)", "(vINT + 1)", "(vREAL * 2)", "(vBOOL AND vBOOL)", "ADR(vINT)",
    "SIZEOF(vStruct)", "0.0", "cTenth", "cText", "cList", "THIS", "INT", "ST_Data", "FB_Base", "GVL",
    "vUnknown",
)  # fmt: skip
"""Operands that are no variables."""
OPERANDS = (*DECLARED, *OTHERS)
PARTNERS = (
    "vBOOL", "vBYTE", "vLWORD", "vINT", "vULINT", "vREAL", "vTIME", "vLDT", "vDATE", "vSTRING", "vWSTRING",
    "vPointer", "vReference", "vEnum", "vSubrange", "vAlias", "vArray", "vStruct", "vBlock", "vInterface",
    "vUnion", "vBlockPointer", "vTextPointer", "vStruct.flag", "1", "-1", "1.5", "TRUE", "'a'", "T#1s",
    "vBlock.Level",
)  # fmt: skip
"""What stands on the other side of an operator with two operands, in the table of all operands."""
UNARY = (
    "NOT {0}", "-{0}", "({0})", "ABS({0})", "SQRT({0})", "LN({0})", "EXP({0})", "SIN({0})", "ATAN({0})",
    "TRUNC({0})", "TRUNC_INT({0})", "SIZEOF({0})", "XSIZEOF({0})", "ADR({0})", "BITADR({0})", "{0}^", "{0}.1",
    "{0}[0]", "__ISVALIDREF({0})", "LEN({0})", "LEFT({0}, 1)", "WLEN({0})", "LOWER_BOUND({0}, 1)",
    "MOVE({0})", "Count({0})", "Count(n := {0})", "Open({0}, {0})", "vBlock({0})", "vBlock(in := {0})",
    "vTimer(IN := {0}, PT := {0})", "{0}()", "{0}.Level", "TEST_AND_SET({0})", "__NEW({0})",
    "__POUNAME()", "LTRUNC({0})", "FLOOR({0})", "ROUND({0}, 1)", "{0}.n",
)  # fmt: skip
BINARY = (
    "{0} + {1}", "{0} - {1}", "{0} * {1}", "{0} / {1}", "{0} MOD {1}", "{0} AND {1}", "{0} XOR {1}",
    "{0} AND_THEN {1}", "{0} = {1}", "{0} <> {1}", "{0} < {1}", "{0} >= {1}", "EXPT({0}, {1})",
    "MIN({0}, {1})", "MAX({1}, {0})", "SHL({0}, {1})", "ROR({0}, {1})", "SEL(vBOOL, {0}, {1})",
    "SEL({0}, {1}, {1})", "MUX({0}, {1}, {1})", "MUX(vINT, {0}, {1})", "LIMIT({0}, {1}, {0})",
    "CONCAT({0}, {1})", "FIND({0}, {1})", "MID({0}, {1}, {1})", "vArray[{0}]", "vMatrix[{0}, {1}]",
    "ADD({0}, {1})", "GT({0}, {1})", "__QUERYINTERFACE({0}, {1})", "__QUERYPOINTER({0}, {1})",
    "ATAN2({0}, {1})",
)  # fmt: skip
ACTIONS = (
    "{0} := {1};", "{0} REF= {1};", "{0} S= {1};", "IF {0} THEN vINT := 1; END_IF", "vINT := vINT + {0};",
    "WHILE {0} DO EXIT; END_WHILE", "CASE {0} OF 1: vINT := 1; 2..3: vINT := 2; END_CASE",
    "CASE {0} OF {1}: vINT := 1; END_CASE", "FOR {0} := {1} TO {1} DO EXIT; END_FOR",
    "FOR vINT := {0} TO {1} BY {1} DO EXIT; END_FOR", "FOR vULINT := 1 TO 3 BY {0} DO EXIT; END_FOR",
    "vArray[{0}] := {1};", "{0}^ := {1};", "{0}.2 := {1};", "vBlock.Level := {0};", "vStruct.flag := {0};",
    "vBlock(in := {0}, out => {1});", "__DELETE({0});", "{0} := {1} := {0};",
    "REPEAT vINT := 1; UNTIL {0} END_REPEAT",
)  # fmt: skip


def conversions() -> Iterator[str]:
    """All names of conversions."""
    for target in ELEMENTARY:
        yield f"TO_{target}"
        for source in (*ELEMENTARY, *GENERIC):
            yield f"{source}_TO_{target}"


def expressions() -> Iterator[str]:
    """All expressions of the table."""
    for name, operand in product(conversions(), OPERANDS):
        yield f"{name}({operand})"
    for form, operand in product(UNARY, OPERANDS):
        yield form.format(operand)
    for form, left, right in product(BINARY, OPERANDS, PARTNERS):
        yield form.format(left, right)


def actions() -> Iterator[str]:
    """All statements that are no assignment of an expression to a variable of its type."""
    for form in ACTIONS:
        if "{1}" in form:
            yield from (form.format(left, right) for left, right in product(OPERANDS, PARTNERS))
            yield from (form.format(left, right) for left, right in product(PARTNERS, OTHERS))
        else:
            yield from (form.format(operand) for operand in OPERANDS)


class Table:
    """A program with some statements of the table, one a line, in functions of some hundred lines."""

    CHUNK = 100

    def __init__(self, lines: list[str]) -> None:
        self.lines = lines

    @property
    def declarations(self) -> str:
        own = "".join(f"{name} : {type_};\n" for name, type_ in DECLARED.items())
        constants = "cTenth : REAL := 0.1; cText : STRING := 'text'; cList : ARRAY[0..1] OF INT := [1, 2];"
        return f"{TYPES}VAR_GLOBAL\n{own}END_VAR\nVAR_GLOBAL CONSTANT {constants} END_VAR\n"

    def sources(self) -> list[Source]:
        """The texts: line n of a body is statement n of its chunk."""
        found = [Source("declared", self.declarations, name=None)]
        calls = []
        for number, start in enumerate(range(0, len(self.lines), self.CHUNK)):
            body = "\n".join(self.lines[start : start + self.CHUNK])
            found.append(Source(str(number), f"FUNCTION F{number} : INT\n{body}\nEND_FUNCTION"))
            calls.append(f"F{number}();")
        calls_text = "\n".join(calls)
        found.append(Source("main", f"PROGRAM PLC_PRG\n{calls_text}\nEND_PROGRAM"))
        return found

    def place(self, uri: str, line: int) -> int | None:
        """Number of the statement at a line counted from 0; None outside the table."""
        return int(uri) * self.CHUNK + line - 1 if uri.isdigit() and line > 0 else None


def sinks() -> dict[str, str]:
    """A variable for results of a type, by the name of the type."""
    names = {"TOD": "TIME_OF_DAY", "DT": "DATE_AND_TIME", "LTOD": "LTIME_OF_DAY", "LDT": "LDATE_AND_TIME"}
    return {names.get(type_, type_): name for name, type_ in DECLARED.items()}


def refused(lines: list[str], libraries: list[Source]) -> tuple[set[int], dict[int, str]]:
    """Numbers of the lines with errors, and the types of the lines that are expressions."""
    table = Table(lines)
    units = [parse(source) for source in [*table.sources(), *libraries]]
    analysis = analyse([u.unit for u in units])
    found: set[int] = set()
    for d in [d for u in units for d in u.diagnostics] + analysis.diagnostics:
        number = table.place(d.uri, d.span.line)
        if d.severity == "error" and number is not None:
            found.add(number)
    types: dict[int, str] = {}
    for pou in analysis.pous:
        if pou.source is None or not pou.source.uri.isdigit() or pou.pou is None:
            continue
        for s in statements(pou.pou.body):
            number = table.place(pou.source.uri, s.span.line)
            e = s.expr if isinstance(s, ast.ExprStmt) else s.call if isinstance(s, ast.CallStmt) else None
            if e is not None and e.type is not None and number is not None:
                types[number] = str(e.type)
    return found, types
