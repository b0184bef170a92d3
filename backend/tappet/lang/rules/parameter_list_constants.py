"""A parameter list holds constants only: a library reference gives them values before anything runs.

Source: CODESYS object "Parameter list"; spec LIB-02.

Passes:
    {attribute 'parameter_list'}
    VAR_GLOBAL CONSTANT cMax : INT := 5; END_VAR
Fails:
    {attribute 'parameter_list'}
    VAR_GLOBAL nMax : INT := 5; END_VAR   (* E0451: a reference gives values to constants *)
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang.parameter_lists import is_parameter_list

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Session

CODES = ("E0451",)


def check_program(session: Session) -> None:
    """Reports variables of parameter lists."""
    for gvl in session.analysis.gvls:
        if gvl.decl is None or gvl.source is None or not is_parameter_list(gvl.decl):
            continue
        for block in gvl.decl.blocks:
            if block.section == "VAR_GLOBAL" and "CONSTANT" not in block.flags:
                for variable in block.variables:
                    place = gvl.source.uri, variable.name_span
                    session.report("E0451", *place, name=variable.name, list=gvl.name)
