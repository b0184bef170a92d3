"""Words that completion proposes, by the place they fit."""

from __future__ import annotations

from typing import Final

from tappet.iec.words import CONSTANTS, GLOBAL_SECTIONS, OBJECT_HEADS, SECTIONS, WORD_OPERATORS

OBJECT_KEYWORDS: Final = (*sorted(OBJECT_HEADS - {"TRANSITION"}), *sorted(GLOBAL_SECTIONS - {"VAR_ACCESS"}))
"""What begins a text; transitions are parts of charts, and access paths have no effect."""
DECLARATION_KEYWORDS: Final = tuple(sorted(SECTIONS - GLOBAL_SECTIONS))
EXPRESSION_KEYWORDS: Final = (*WORD_OPERATORS, *CONSTANTS)
STATEMENT_SNIPPETS: Final = (
    ("IF ... END_IF", "IF ${1:condition} THEN\n    $0\nEND_IF", "branch"),
    (
        "IF ... ELSE ... END_IF",
        "IF ${1:condition} THEN\n    $2\nELSE\n    $0\nEND_IF",
        "branch with alternative",
    ),
    ("CASE ... END_CASE", "CASE ${1:selector} OF\n    ${2:1}: $0\nEND_CASE", "selection"),
    ("FOR ... END_FOR", "FOR ${1:i} := ${2:0} TO ${3:9} DO\n    $0\nEND_FOR", "counted loop"),
    ("WHILE ... END_WHILE", "WHILE ${1:condition} DO\n    $0\nEND_WHILE", "loop while"),
    ("REPEAT ... END_REPEAT", "REPEAT\n    $0\nUNTIL ${1:condition}\nEND_REPEAT", "loop until"),
)
"""Label, text with places to fill, explanation."""
TYPE_KEYWORDS: Final = (
    ("ARRAY", "ARRAY[${1:0}..${2:9}] OF $0"),
    ("POINTER TO", "POINTER TO $0"),
    ("REFERENCE TO", "REFERENCE TO $0"),
    ("REF_TO", "REF_TO $0"),
    ("STRING(n)", "STRING(${1:80})"),
)
ATTRIBUTES: Final = (
    ("call_after_init", "method: call it after the initialisation"),
    ("displaymode", "variable: number format of its monitored value, 'hex', 'bin' or 'dec'"),
    ("enable_dynamic_creation", "function block: __NEW may create it"),
    ("global_init_slot", "list: order of initialisation, lower is earlier"),
    ("hide", "not shown in lists of components"),
    ("hide_all_locals", "locals are not shown in lists of components"),
    ("iec_name", "input of a library: its name in IEC 61131-3, accepted with a warning"),
    ("init_on_onlchange", "variable: initialised at every online change"),
    ("initialize_on_call", "input: initialised at every call"),
    ("instance-path", "STRING: initialised with the path of the instance"),
    ("linkalways", "compiled and downloaded even if nothing calls it"),
    ("monitoring", "property: 'variable' or 'call'"),
    ("no_check", "POU: without the implicit check functions"),
    ("no_copy", "variable: not copied at an online change"),
    ("no_init", "variable: keeps its value over a reset"),
    ("no_return_type", "function: may be without a return type, as in other systems"),
    ("obsolete", "every use gives a warning with the text of the value"),
    ("pack_mode", "structure: largest gap between members, '0', '1', '2', '4' or '8'"),
    ("parameter_list", "list: constants of a library to which its users may give values"),
    ("qualified_only", "list or enumeration: members only with its name in front"),
    ("reflection", "POU: has variables with 'instance-path'"),
    ("strict", "enumeration: no integers, no arithmetic"),
    ("symbol", "exported variable: 'none', 'read', 'write' or 'readwrite'"),
)
"""Attributes the product knows (spec LPRG-21..LPRG-45), with what they do."""
