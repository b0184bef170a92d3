"""A program that reads CNC files with expressions and subprograms: SMC_ReadNCFile2 and SMC_NCInterpreter."""

from __future__ import annotations

import ast
from dataclasses import dataclass

from file_programs import FileProgram

OBJECTS = 400
MEMBERS = ("dX", "dY", "dZ", "dA", "dA1", "dA2")
PROGRAM = f"""PROGRAM PLC_PRG
VAR
    rf       : SMC_ReadNCFile2;
    nci      : SMC_NCInterpreter;
    aBuffer  : ARRAY[1..50] OF SMC_GEOINFO;
    xExecute : BOOL;
    xVariables : BOOL := TRUE;
    xFunctions : BOOL;
    xModify  : BOOL;
    g_lr     : LREAL := 2.5;
    g_i      : INT := 7;
    g_x      : BOOL := TRUE;
    g_s      : STRING := 'part';
    g_m      : SMC_M_PARAMETERS := (dP3 := 33);
    asv      : ARRAY[0..4] OF SMC_SingleVar := [
        (strVarName := 'G_LR', eVarType := SMC_TYPE_LREAL),
        (strVarName := 'G_I', eVarType := SMC_TYPE_INT),
        (strVarName := 'G_X', eVarType := SMC_TYPE_BOOL),
        (strVarName := 'G_S', eVarType := SMC_TYPE_STRING),
        (strVarName := 'G_M', eVarType := SMC_TYPE_M_PARAMETERS)];
    vl       : SMC_VarList := (wNumberVars := 5);
    sel3     : SELECTION;
    counter  : COUNTER;
    per60    : PER_MINUTE;
    aFunctions : ARRAY[0..1] OF SMC_NC_GFunction;
    table    : SMC_NC_GFunctionTable;
    pGeo     : POINTER TO SMC_GEOINFO;
    xTakes   : BOOL := TRUE;
    nTaken   : DINT;
    fSum     : LREAL; (* Of the ends, each times its number *)
    afEnds   : ARRAY[0..{OBJECTS * len(MEMBERS) - 1}] OF LREAL;
    aiKinds  : ARRAY[0..{OBJECTS - 1}] OF DINT;
    afParameters : ARRAY[0..{OBJECTS - 1}] OF LREAL;
    afLengths : ARRAY[0..{OBJECTS - 1}] OF LREAL;
    stLast   : SMC_GEOINFO;
    sText    : STRING(255);
    iDepth   : INT;
    iMost    : INT;
    iJumps   : INT;
END_VAR
asv[0].pAdr := ADR(g_lr);
asv[1].pAdr := ADR(g_i);
asv[2].pAdr := ADR(g_x);
asv[3].pAdr := ADR(g_s);
asv[4].pAdr := ADR(g_m);
vl.psvVarList := ADR(asv);
aFunctions[0].stName := 'SEL';
aFunctions[0].iFunc := sel3;
aFunctions[1].stName := 'NEXT';
aFunctions[1].iFunc := counter;
table.numFunctions := 2;
table.pFunction := ADR(aFunctions);
rf.pvl := 0;
IF xVariables THEN
    rf.pvl := ADR(vl);
END_IF
rf.pCustomFunTable := 0;
IF xFunctions THEN
    rf.pCustomFunTable := ADR(table);
END_IF
rf.aTokenModifier[0] := 0;
IF xModify THEN
    rf.aTokenModifier[0] := per60;
END_IF
rf(bExecute := xExecute);
nci(sentences := rf.sentences, bExecute := rf.bExecuteDecoder, nSizeOutQueue := SIZEOF(aBuffer),
    pbyBufferOutQueue := ADR(aBuffer));
IF nci.GCodeText.bNewLine THEN
    sText := nci.GCodeText.str;
END_IF
WHILE xTakes AND SMC_GetCount(nci.poqDataOut) > 0 DO
    pGeo := SMC_GetObj(nci.poqDataOut, 0);
    stLast := pGeo^;
    IF nTaken < {OBJECTS} THEN
        aiKinds[nTaken] := stLast.iMoveType;
        afLengths[nTaken] := stLast.dLength;
        afParameters[nTaken] := stLast.dT1;
        {
    "".join(
        f"afEnds[nTaken * {len(MEMBERS)} + {i}] := stLast.piDestPos.{name};" for i, name in enumerate(MEMBERS)
    )
}
    END_IF
    nTaken := nTaken + 1;
    fSum := fSum + nTaken * stLast.piDestPos.dX;
    IF pGeo^.pPassed <> 0 THEN
        pGeo^.pPassed^ := TRUE;
    END_IF
    SMC_DeleteObj(nci.poqDataOut, 0);
END_WHILE
END_PROGRAM

(* SEL of IEC 61131-3: T_OTHER is any type. *)
FUNCTION_BLOCK SELECTION IMPLEMENTS SMC_NC_IFunction
VAR
    aTypes : ARRAY[0..2] OF SMC_GVar_Type := [
        SMC_GVar_Type.T_BOOL, SMC_GVar_Type.T_OTHER, SMC_GVar_Type.T_OTHER];
END_VAR
METHOD GetSignature
VAR_OUTPUT
    resultType : SMC_GVar_Type;
    nNumArguments : UDINT;
    pType : POINTER TO SMC_GVar_Type;
END_VAR
resultType := SMC_GVar_Type.T_OTHER;
nNumArguments := 3;
pType := ADR(aTypes);
END_METHOD
METHOD Call
VAR_IN_OUT
    result : SMC_GVar;
END_VAR
VAR_INPUT
    pArguments : POINTER TO SMC_GVar;
END_VAR
VAR_OUTPUT
    Error : BOOL;
END_VAR
IF pArguments[0].bValue THEN
    result := pArguments[2];
ELSE
    result := pArguments[1];
END_IF
END_METHOD
END_FUNCTION_BLOCK

(* Counts its calls; refuses the fourth one. *)
FUNCTION_BLOCK COUNTER IMPLEMENTS SMC_NC_IFunction
VAR
    iCalls : INT;
END_VAR
METHOD GetSignature
VAR_OUTPUT
    resultType : SMC_GVar_Type;
    nNumArguments : UDINT;
    pType : POINTER TO SMC_GVar_Type;
END_VAR
resultType := SMC_GVar_Type.T_LREAL;
nNumArguments := 0;
pType := 0;
END_METHOD
METHOD Call
VAR_IN_OUT
    result : SMC_GVar;
END_VAR
VAR_INPUT
    pArguments : POINTER TO SMC_GVar;
END_VAR
VAR_OUTPUT
    Error : BOOL;
END_VAR
iCalls := iCalls + 1;
result.fValue := iCalls;
Error := iCalls > 3;
END_METHOD
END_FUNCTION_BLOCK

(* Velocities per minute: 1/60 * in front of the value of F. *)
FUNCTION_BLOCK PER_MINUTE IMPLEMENTS SMC_ITokenModifier
VAR
    fbToken : SMC_Token;
    xAfterF : BOOL;
END_VAR
METHOD Reset
xAfterF := FALSE;
END_METHOD
METHOD Call
VAR_IN_OUT
    tokensIn : SMC_TokenQueue;
    tokensOut : SMC_TokenQueue;
    errorPos : SMC_NC_SourcePosition;
END_VAR
VAR_OUTPUT
    Done : BOOL;
    Error : BOOL;
    ErrorID : SM3_Basic.SMC_ERROR;
END_VAR
VAR
    pToken : POINTER TO SMC_Token;
END_VAR
pToken := tokensIn.Peek(0);
IF pToken <> 0 THEN
    Error := pToken^.Is(SMC_TOKENTYPE.identifier, 'Q');
    errorPos := pToken^.srcPos;
    tokensOut.Append(pToken);
    IF pToken^.Is(SMC_TOKENTYPE.identifier, 'F') THEN
        fbToken.srcPos := pToken^.srcPos;
        fbToken.SetNumber(1.0 / 60.0);
        tokensOut.Append(ADR(fbToken));
        fbToken.tokenType := SMC_TOKENTYPE.operator;
        fbToken.SetString('*');
        tokensOut.Append(ADR(fbToken));
    END_IF
    tokensIn.RemoveFirst();
END_IF
Done := TRUE;
END_METHOD
END_FUNCTION_BLOCK
"""


@dataclass
class Outcome:
    """What became of a program."""

    reader: str
    interpreter: str
    ends: list[tuple[float, ...]]
    """X Y Z A P Q at the end of each object."""
    kinds: list[int]
    lengths: list[float]
    parameters: list[float]
    """Words K of M functions."""
    messages: tuple[str, str]
    """Of the reader and of the interpreter."""

    @property
    def done(self) -> bool:
        return (self.reader, self.interpreter) == ("SMC_NO_ERROR", "SMC_NO_ERROR")

    @property
    def xs(self) -> list[float]:
        return [end[0] for end in self.ends]

    @property
    def plane(self) -> list[tuple[float, ...]]:
        return [end[:2] for end in self.ends]


class Interpreter(FileProgram):
    text = PROGRAM

    def numbers(self, name: str) -> list[float]:
        return [float(number) for number in ast.literal_eval(self.literal(name))]

    def run(self, files: dict[str, str] | str, cycles: int = 3000) -> Outcome:
        """Runs a program: a text of main.cnc, or files by their names."""
        for name, content in (files if isinstance(files, dict) else {"main.cnc": files}).items():
            path = self.folder / name
            path.parent.mkdir(exist_ok=True)
            path.write_text(content)
        self.set(xExecute=False)
        self.runtime.run(cycles=2)
        self.set(nTaken=0, fSum=0.0, xExecute=True)
        self.runtime.write("PLC_PRG.rf.sFileName", "main.cnc")
        for pin in ("fDefaultVel", "fDefaultAccel", "fDefaultDecel"):
            self.runtime.write(f"PLC_PRG.rf.{pin}", 9.0)
        self.runtime.run(cycles=2)
        for _ in range(cycles):
            busy = [self.runtime.read(f"PLC_PRG.{block}.bBusy") for block in ("rf", "nci")]
            if not busy[1] and (not busy[0] or self.literal("nci.bError") == "TRUE"):
                break
            self.runtime.run(cycles=3)
        else:
            raise AssertionError("neither done nor an error")
        self.runtime.run(cycles=1)
        return self.outcome()

    def outcome(self) -> Outcome:
        count = min(int(self.literal("nTaken")), OBJECTS)
        ends = self.numbers("afEnds") if count else []
        width = len(MEMBERS)
        return Outcome(
            self.literal("rf.ErrorID"),
            self.literal("nci.wErrorID"),
            [tuple(ends[n * width : (n + 1) * width]) for n in range(count)],
            [int(kind) for kind in self.numbers("aiKinds")[:count]] if count else [],
            self.numbers("afLengths")[:count] if count else [],
            self.numbers("afParameters")[:count] if count else [],
            (self.literal("rf.sErrorText").strip("'"), self.literal("nci.sErrorText").strip("'")),
        )
