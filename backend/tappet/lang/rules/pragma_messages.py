"""Message pragmas give their text; a pragma that nobody knows is named.

`{error 'text'}` stops the build, `{warning 'text'}`, `{info 'text'}` and `{text 'text'}` do not. What is
wrong with a cam or a CNC program stands with the word `cam` or `cnc` in front in the text that is made of it.

Source: spec LPRG-05, LPRG-10..LPRG-14, CAM-74, CNC-37.

Passes:
    VAR a : INT; END_VAR
    {region 'start'}
    a := 1;
    {endregion}
Passes:
    {library public}
    VAR a : INT; END_VAR
    {flow}                         (* of CoDeSys 2.3, without effect *)
    a := 1;
    {noflow}
Fails:
    VAR a : INT; END_VAR
    {warning 'not tested'}         (* W1208: the text *)
    a := 1;
Fails:
    VAR a : INT; END_VAR
    {info 'name of the author'}    (* W1211: the text, with its place *)
    a := 1; {text 'part one is done'}  (* W1212: the text, without one *)
Fails:
    VAR a : INT; END_VAR
    {warning cam 'The velocity jumps from 1 to 0 at X = 90'}  (* W1225: as an editor of cams says it *)
    a := 1;
Fails:
    VAR a : INT; END_VAR
    {error cam 'Its end is not its start'}  (* E0452: the same where the cam cannot be used *)
    a := 1;
Fails:
    VAR a : INT; END_VAR
    {warning cnc 'Line 1 has the block number N10 too; a jump goes there'}  (* W1226: of a CNC program *)
    a := 1;
Fails:
    VAR a : INT; END_VAR
    {error cnc 'G77 is no command'}  (* E0453: the same where it cannot be decoded *)
    a := 1;
Fails:
    VAR a : INT; END_VAR
    {nonsense 17}                  (* W1210: unknown *)
    a := 1;
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import TYPE_CHECKING

from tappet.lang import ast

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body

CODES = ("E0433", "E0452", "E0453", "W1208", "W1210", "W1211", "W1212", "W1225", "W1226")
NODES = (ast.PragmaStmt,)
_MESSAGE = re.compile(r"(text|info|warning|error)\s+(?:\d\s+)?(['\"]?)(.*?)\2\s*$", re.IGNORECASE | re.DOTALL)
_CODES = {"text": "W1212", "info": "W1211", "warning": "W1208", "error": "E0433"}
_OBJECT = re.compile(r"(warning|error)\s+(cam|cnc)\s+'(.*)'\s*$", re.IGNORECASE | re.DOTALL)
_OBJECT_CODES = {
    ("warning", "cam"): "W1225",
    ("error", "cam"): "E0452",
    ("warning", "cnc"): "W1226",
    ("error", "cnc"): "E0453",
}
_KNOWN = re.compile(
    r"(attribute|define|undefine|if|elsif|else|end_if|include|region|endregion|flag|bitaccess|implicit|"
    r"warning\s+(disable|restore)|analysis|messageguid|s|"
    r"flow|noflow|library|nonpersistent|parameter|template|instance)\b",
    re.IGNORECASE,
)


def check_statement(b: Body, s: ast.PragmaStmt) -> None:
    """Reports one pragma of a body."""
    report_pragmas(b, [s.pragma])


def check_pou(b: Body) -> None:
    """Reports the pragmas of the declaration part."""
    if b.pou is None or b.pou.pou is None:
        return
    pou = b.pou.pou
    report_pragmas(b, pou.attributes)
    for block in pou.blocks:
        report_pragmas(b, block.attributes)
        for decl in block.variables:
            if decl.attributes:
                report_pragmas(b, decl.attributes)


def report_pragmas(b: Body, pragmas: Iterable[ast.Pragma]) -> None:
    """Gives the text of message pragmas and names unknown ones."""
    for pragma in pragmas:
        if pragma.attribute is not None:
            continue
        text = pragma.text.strip()
        if _KNOWN.match(text):
            continue
        about = _OBJECT.match(text)
        message = _MESSAGE.match(text)
        if about is not None:
            b.report(_OBJECT_CODES[about[1].lower(), about[2].lower()], pragma.span, text=about[3])
        elif message is not None:
            b.report(_CODES[message[1].lower()], pragma.span, text=message[3])
        else:
            b.report("W1210", pragma.span, text=text)
