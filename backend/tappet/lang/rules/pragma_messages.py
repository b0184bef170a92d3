"""Message pragmas give their text; a pragma that nobody knows is named.

`{error 'text'}` stops the build, `{warning 'text'}`, `{info 'text'}` and `{text 'text'}` do not. What is
wrong with a cam stands with the word `cam` in front in the text that is made of it.

Source: spec LPRG-05, LPRG-10..LPRG-14, CAM-74.

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

CODES = ("E0433", "E0452", "W1208", "W1210", "W1211", "W1212", "W1225")
NODES = (ast.PragmaStmt,)
_MESSAGE = re.compile(r"(text|info|warning|error)\s+(?:\d\s+)?(['\"]?)(.*?)\2\s*$", re.IGNORECASE | re.DOTALL)
_CODES = {"text": "W1212", "info": "W1211", "warning": "W1208", "error": "E0433"}
_CAM = re.compile(r"(warning|error)\s+cam\s+'(.*)'\s*$", re.IGNORECASE | re.DOTALL)
_CAM_CODES = {"warning": "W1225", "error": "E0452"}
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
        cam = _CAM.match(text)
        message = _MESSAGE.match(text)
        if cam is not None:
            b.report(_CAM_CODES[cam[1].lower()], pragma.span, text=cam[2])
        elif message is not None:
            b.report(_CODES[message[1].lower()], pragma.span, text=message[3])
        else:
            b.report("W1210", pragma.span, text=text)
