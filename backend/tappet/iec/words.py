"""The words of IEC 61131-3 with a meaning of their own: keywords, sections, ends, types, operators.

One table each, in upper case; what reads, formats, completes or colours texts takes its words from here, and
the editors in the browser from what `iec.typescript` makes of it.
"""

from __future__ import annotations

from typing import Final, NamedTuple

_WORDS = """
    PROGRAM END_PROGRAM FUNCTION END_FUNCTION FUNCTION_BLOCK END_FUNCTION_BLOCK METHOD END_METHOD
    ACTION END_ACTION TRANSITION END_TRANSITION PROPERTY END_PROPERTY END_GET END_SET INTERFACE END_INTERFACE
    TYPE END_TYPE STRUCT END_STRUCT UNION END_UNION
    VAR VAR_INPUT VAR_OUTPUT VAR_IN_OUT VAR_GLOBAL VAR_TEMP VAR_STAT VAR_INST VAR_EXTERNAL VAR_CONFIG
    VAR_ACCESS VAR_GENERIC END_VAR CONSTANT RETAIN NON_RETAIN PERSISTENT
    AT ARRAY OF POINTER REFERENCE TO
    IF THEN ELSIF ELSE END_IF CASE END_CASE FOR DO END_FOR WHILE END_WHILE REPEAT UNTIL END_REPEAT
    EXIT CONTINUE RETURN JMP __TRY __CATCH __FINALLY __ENDTRY
    AND OR XOR NOT MOD AND_THEN OR_ELSE TRUE FALSE THIS SUPER PARAMS
"""
KEYWORDS: Final = frozenset(_WORDS.split())
"""Words with a fixed meaning in declarations and ST (LDEC-10). Others (GET, PUBLIC, BY) count by their place
only."""
_RESERVED = """
    ABS ABSTRACT ACOS ACTION ADD ADR AND AND_THEN ARRAY ASIN AT ATAN BITADR BOOL BY BYTE CASE CONSTANT
    CONTINUE COS DATE DATE_AND_TIME DINT DIV DO DT DWORD ELSE ELSIF END_ACTION END_CASE END_FOR
    END_FUNCTION END_FUNCTION_BLOCK END_IF END_INTERFACE END_METHOD END_PROGRAM END_PROPERTY END_REPEAT
    END_STRUCT END_TYPE END_UNION END_VAR END_WHILE EXIT EXP EXPT EXTENDS FALSE FINAL FOR FUNCTION
    FUNCTION_BLOCK IF IMPLEMENTS INDEXOF INT INTERFACE INTERNAL LDATE LDT LINT LN LOG LREAL LTIME LTOD
    LWORD MAX METHOD MIN MOD MOVE MUL MUX NOT OF OR OR_ELSE PARAMS PERSISTENT POINTER PRIVATE PROGRAM
    PROPERTY PROTECTED PUBLIC READ_ONLY READ_WRITE REAL REFERENCE REPEAT RETAIN RETURN ROL ROR SEL SHL
    SHR SIN SINT SIZEOF SQRT STRING STRUCT SUB SUPER TAN THEN THIS TIME TIME_OF_DAY TO TOD TRUE TRUNC
    TRUNC_INT TYPE UDINT UINT ULINT UNION UNTIL USINT VAR VAR_ACCESS VAR_CONFIG VAR_EXTERNAL VAR_GLOBAL
    VAR_INPUT VAR_INST VAR_IN_OUT VAR_OUTPUT VAR_STAT VAR_TEMP WHILE WORD WSTRING XOR
"""
RESERVED: Final = frozenset(_RESERVED.split())
"""Words that cannot name an object (LDEC section 9). Operators of IL alone (LD, ST, S, R, JMP ...) may."""

SECTIONS: Final = frozenset(word for word in KEYWORDS if word == "VAR" or word.startswith("VAR_"))
"""Keywords that open a block of variables (LDEC-02)."""
GLOBAL_SECTIONS: Final = frozenset(["VAR_GLOBAL", "VAR_CONFIG", "VAR_ACCESS"])
"""Those that stand outside of POUs."""
GENERIC_SECTION: Final = "VAR_GENERIC"
"""The block of generic constants, which CODESYS writes before EXTENDS and IMPLEMENTS."""
SECTION_FLAGS: Final = ("CONSTANT", "RETAIN", "NON_RETAIN", "PERSISTENT")
"""Words between a section keyword and its variables."""

ACCESS_SPECIFIERS: Final = ("PUBLIC", "PROTECTED", "PRIVATE", "INTERNAL")
"""Who may use a POU, a method or the variables of a section."""
INHERITANCE_MODIFIERS: Final = ("ABSTRACT", "FINAL", "OVERRIDE")
"""What derived blocks do with a POU or a method."""
MODIFIERS: Final = frozenset([*ACCESS_SPECIFIERS, *INHERITANCE_MODIFIERS])
"""Words between the keyword and the name of a header."""

ACCESSORS: Final = ("GET", "SET")
CHILD_HEADS: Final = frozenset(["METHOD", "ACTION", "TRANSITION", "PROPERTY"])
"""Keywords that begin what belongs to a POU."""
POU_HEADS: Final = frozenset(["PROGRAM", "FUNCTION", "FUNCTION_BLOCK"])
OBJECT_HEADS: Final = CHILD_HEADS | POU_HEADS | {"INTERFACE", "TYPE"}
"""Keywords that begin an object; they also end a statement list whose own end is missing."""

OBJECT_ENDS: Final = {word: f"END_{word}" for word in (*sorted(OBJECT_HEADS), *ACCESSORS)}
"""Keyword that begins an object or accessor to the keyword that closes it."""
STRUCTURE_ENDS: Final = {"STRUCT": "END_STRUCT", "UNION": "END_UNION"}
STATEMENT_ENDS: Final = {
    "IF": "END_IF",
    "CASE": "END_CASE",
    "FOR": "END_FOR",
    "WHILE": "END_WHILE",
    "REPEAT": "END_REPEAT",
    "__TRY": "__ENDTRY",
}
"""Keyword of a compound statement to the keyword that closes it."""
ENDS: Final = OBJECT_ENDS | STRUCTURE_ENDS | STATEMENT_ENDS
"""Opening keyword to the keyword that closes it."""

STATEMENT_WORDS: Final = (
    "IF", "THEN", "ELSIF", "ELSE", "END_IF", "CASE", "OF", "END_CASE", "FOR", "TO", "BY", "DO", "END_FOR",
    "WHILE", "END_WHILE", "REPEAT", "UNTIL", "END_REPEAT", "EXIT", "CONTINUE", "RETURN", "JMP",
)  # fmt: skip
"""The words of statements as IEC 61131-3 has them, in the order of its chapters."""
WORD_OPERATORS: Final = ("AND", "OR", "XOR", "NOT", "MOD", "AND_THEN", "OR_ELSE")
CONSTANTS: Final = ("TRUE", "FALSE")
INSTANCES: Final = ("THIS", "SUPER")

NULL: Final = "NULL"
"""The reference to nothing of IEC 61131-3; a name like any other elsewhere."""
HEADER_WORDS: Final = ("EXTENDS", "IMPLEMENTS", "READ_ONLY", "READ_WRITE")
"""Words that count by their place in declarations."""
_OPERATOR_FUNCTIONS = """
    ABS ACOS ADD ADR ASIN ATAN BITADR COS DIV EQ EXP EXPT GE GT INDEXOF LE LIMIT LN LOG LT MAX MIN MOVE MUL
    MUX NE ROL ROR SEL SHL SHR SIN SIZEOF SQRT SUB TAN TRUNC TRUNC_INT
"""
OPERATOR_FUNCTIONS: Final = tuple(_OPERATOR_FUNCTIONS.split())
"""Operators in the form of functions (LOPR)."""

OPERATORS: Final = (
    ";", ",", "(", ")", "[", "]", "^", "+", "-", "&", ":=", "?=", "..", ".", ":", "/", "=>", "=", "<=", "<>",
    "<", ">=", ">", "*", "**",
)  # fmt: skip
"""Signs: operators and what stands between operands."""


class ElementaryType(NamedTuple):
    """A type without parts: the family decides the operators that apply, the size is in bytes."""

    family: str
    size: int

    @property
    def signed(self) -> bool:
        """Whether values carry a sign."""
        return self.family in ("signed", "real")


ELEMENTARY_TYPES: Final = {
    "BOOL": ElementaryType("bool", 1),
    "BYTE": ElementaryType("bits", 1),
    "WORD": ElementaryType("bits", 2),
    "DWORD": ElementaryType("bits", 4),
    "LWORD": ElementaryType("bits", 8),
    "SINT": ElementaryType("signed", 1),
    "INT": ElementaryType("signed", 2),
    "DINT": ElementaryType("signed", 4),
    "LINT": ElementaryType("signed", 8),
    "USINT": ElementaryType("unsigned", 1),
    "UINT": ElementaryType("unsigned", 2),
    "UDINT": ElementaryType("unsigned", 4),
    "ULINT": ElementaryType("unsigned", 8),
    "REAL": ElementaryType("real", 4),
    "LREAL": ElementaryType("real", 8),
    "TIME": ElementaryType("time", 4),
    "LTIME": ElementaryType("time", 8),
    "DATE": ElementaryType("date", 4),
    "TIME_OF_DAY": ElementaryType("date", 4),
    "DATE_AND_TIME": ElementaryType("date", 4),
    "LDATE": ElementaryType("date", 8),
    "LTIME_OF_DAY": ElementaryType("date", 8),
    "LDATE_AND_TIME": ElementaryType("date", 8),
}
"""Elementary types by name (LTYP-01)."""
TYPE_SYNONYMS: Final = {
    "TOD": "TIME_OF_DAY",
    "DT": "DATE_AND_TIME",
    "LTOD": "LTIME_OF_DAY",
    "LDT": "LDATE_AND_TIME",
    "BIT": "BOOL",
    "__UXINT": "ULINT",
    "__XINT": "LINT",
    "__XWORD": "LWORD",
}
"""Other names of elementary types; those with underscores have the size of a pointer."""
STRING_TYPES: Final = ("STRING", "WSTRING")

TYPE_PREFIXES: Final = {
    "x": "BOOL", "b": "BOOL", "by": "BYTE", "w": "WORD", "dw": "DWORD", "lw": "LWORD", "si": "SINT",
    "usi": "USINT", "i": "INT", "n": "INT", "ui": "UINT", "di": "DINT", "udi": "UDINT", "li": "LINT",
    "uli": "ULINT", "r": "REAL", "lr": "LREAL", "s": "STRING", "ws": "WSTRING", "tim": "TIME", "t": "TIME",
    "ltim": "LTIME", "tod": "TOD", "dt": "DT", "date": "DATE",
}  # fmt: skip
"""Prefixes of names to the types that they recommend (LDEC-130), as `x` in "xStart"."""


def elementary_type(name: str) -> ElementaryType | None:
    """The elementary type of an upper-case name."""
    return ELEMENTARY_TYPES.get(TYPE_SYNONYMS.get(name, name))
