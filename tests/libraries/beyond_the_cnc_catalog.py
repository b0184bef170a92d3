"""What SM3_CNC has beyond the catalog, with the pins that today's SoftMotion documents for it.

Not from there: `eOriConv` and `bSingular` of the articulated robot, `bZUp` of its dimensions.
"""

_OLD = {f"dQ{axis}_old": "LREAL" for axis in range(6)}
_STATES = {
    "armState": "SMC_ArticulatedRobot_6DOF_J0_State",
    "elbowState": "SMC_ArticulatedRobot_6DOF_J1_State",
    "handState": "SMC_ArticulatedRobot_6DOF_J4_State",
}
_CONFIG = {"config": "SMC_TrafoConfig_ArticulatedRobot_6DOF"}
BLOCKS: dict[str, dict[str, dict[str, str]]] = {
    "SMC_Trafo_ArticulatedRobot_6DOF": {
        "in_out": _CONFIG,
        "inputs": {"pi": "SMC_POSINFO", **_OLD, **_STATES, "eOriConv": "SMC_ORI_CONVENTION"},
        "outputs": {
            **dict.fromkeys(("bError", "bSingular"), "BOOL"),
            **{f"dQ{axis}": "LREAL" for axis in range(6)},
        },
    },
    "SMC_TrafoF_ArticulatedRobot_6DOF": {
        "in_out": {**_CONFIG, **{f"Drive{axis}": "AXIS_REF_SM3" for axis in range(1, 7)}},
        "inputs": {"eOriConv": "SMC_ORI_CONVENTION"},
        "outputs": {"bError": "BOOL", "pi": "SMC_POSINFO", **_STATES},
    },
}
STRUCTURES: dict[str, dict[str, str]] = {
    "SMC_TrafoConfig_ArticulatedRobot_6DOF": {
        **dict.fromkeys(("dA1", "dA2", "dA3", "dD1", "dD3", "dD4", "dD6"), "LREAL"),
        "adOffset": "ARRAY [0..5] OF LREAL",
        "bZUp": "BOOL",
    },
}
ENUMERATIONS = {
    "SMC_ORI_CONVENTION": {"ADDAXES": 0, "ZYZ": 1, "ZYX": 2, "XYZ": 3},
    "SMC_ArticulatedRobot_6DOF_J0_State": {"BACKWARDS": -1, "STRAIGHT": 0, "FORWARD": 1},
    "SMC_ArticulatedRobot_6DOF_J1_State": {"DOWN": -1, "STRAIGHT": 0, "UP": 1},
    "SMC_ArticulatedRobot_6DOF_J4_State": {"DOWN": -1, "STRAIGHT": 0, "UP": 1},
}
PROGRAM_ITEMS: dict[str, list[str]] = {
    "SMC_NC_GFunction": ["stName", "iFunc"],
    "SMC_NC_GFunctionTable": ["numFunctions", "pFunction"],
    "SMC_GVar_Type": ["T_UNKNOWN", "T_BOOL", "T_LREAL", "T_STRING", "T_OTHER"],
    "SMC_PositionTracker": [
        *("bEnable", "bClear", "dX", "dY", "dZ", "udiNumberOfPointsInArray", "pBuffer"),
        "vs3dt",
    ],
    "SMC_PathCopierFile": [
        *("bExecute", "udiNumberOfPointsInArray", "pBuffer", "sFileName", "pvl", "piStartPosition"),
        *("aSubProgramDirs", "bParenthesesAsComments", "bEnableSyntaxChecks", "bStepSuppress"),
        *("pCustomFunTable", "dPrecision"),
        *("bDone", "bBusy", "bError", "iErrorID", "vs3dt"),
    ],
    "VisuStruct3DTrack": [
        *("pData", "udiNumberOfPointsInArray", "udiFirstPoint", "udiNumberOfPointsToDraw"),
    ],
    "VisuStruct3DPathPoint": ["v", "udiSourceElementID", "dwAddInfo"],
}
"""Programs, functions of the application and tracks: pins, members or values.

SMC_ITokenModifier, SMC_NC_IFunction and SMC_TokenQueue are interfaces and methods; tests/runtime uses them.
"""
