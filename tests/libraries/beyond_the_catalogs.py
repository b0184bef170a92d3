"""Pins of what SM3_Basic offers beyond the catalogs of the specification, as their sources have them.

Source of the MC_ blocks: PLCopen, Function blocks for motion control, part 1 and 2, version 2.0. Types are
those of the library for the generic ones of the standard; an axis and its error have the names of SoftMotion.
"""

from __future__ import annotations

_EXECUTE = {"Execute": "BOOL"}
_ENABLE = {"Enable": "BOOL"}
_RAMP = {"Acceleration": "LREAL", "Deceleration": "LREAL", "Jerk": "LREAL"}
_BUFFER = {"BufferMode": "MC_BUFFER_MODE"}
_ERROR = {"Error": "BOOL", "ErrorID": "SMC_ERROR"}
_ENDED = {"Busy": "BOOL", "CommandAborted": "BOOL", **_ERROR}
_MOVED = {"Active": "BOOL", **_ENDED}
_AXIS = {"Axis": "AXIS_REF_SM3"}
_COUPLED = {"Master": "AXIS_REF_SM3", "Slave": "AXIS_REF_SM3"}
_OVERRIDE = {
    "in_out": _AXIS,
    "inputs": {**_ENABLE, "VelFactor": "LREAL", "AccFactor": "LREAL", "JerkFactor": "LREAL"},
    "outputs": {"Enabled": "BOOL", "Busy": "BOOL", **_ERROR},
}

BLOCKS: dict[str, dict[str, dict[str, str]]] = {
    "MC_SetOverride": _OVERRIDE,
    "SMC_SetOverride": _OVERRIDE,
    "SMC_GetOverride": {
        "in_out": _AXIS,
        "inputs": _ENABLE,
        "outputs": {
            "Valid": "BOOL",
            "Busy": "BOOL",
            "VelFactor": "LREAL",
            "AccFactor": "LREAL",
            "JerkFactor": "LREAL",
        },
    },
    "MC_HaltSuperimposed": {
        "in_out": _AXIS,
        "inputs": {**_EXECUTE, "Deceleration": "LREAL", "Jerk": "LREAL"},
        "outputs": {"Done": "BOOL", **_ENDED},
    },
    "MC_MoveContinuousAbsolute": {
        "in_out": _AXIS,
        "inputs": {
            **_EXECUTE,
            "Position": "LREAL",
            "Velocity": "LREAL",
            "EndVelocity": "LREAL",
            **_RAMP,
            "Direction": "MC_DIRECTION",
            **_BUFFER,
        },
        "outputs": {"InEndVelocity": "BOOL", **_MOVED},
    },
    "MC_MoveContinuousRelative": {
        "in_out": _AXIS,
        "inputs": {
            **_EXECUTE,
            "Distance": "LREAL",
            "Velocity": "LREAL",
            "EndVelocity": "LREAL",
            **_RAMP,
            **_BUFFER,
        },
        "outputs": {"InEndVelocity": "BOOL", **_MOVED},
    },
    "MC_PhasingAbsolute": {
        "in_out": _COUPLED,
        "inputs": {**_EXECUTE, "PhaseShift": "LREAL", "Velocity": "LREAL", **_RAMP},
        "outputs": {"Done": "BOOL", **_ENDED, "AbsolutePhaseShift": "LREAL"},
    },
    "MC_PhasingRelative": {
        "in_out": _COUPLED,
        "inputs": {**_EXECUTE, "PhaseShift": "LREAL", "Velocity": "LREAL", **_RAMP},
        "outputs": {"Done": "BOOL", **_ENDED, "CoveredPhaseShift": "LREAL"},
    },
    "MC_ReadMotionState": {
        "in_out": _AXIS,
        "inputs": {**_ENABLE, "Source": "MC_SOURCE"},
        "outputs": {
            "Valid": "BOOL",
            "Busy": "BOOL",
            **_ERROR,
            "ConstantVelocity": "BOOL",
            "Accelerating": "BOOL",
            "Decelerating": "BOOL",
            "DirectionPositive": "BOOL",
            "DirectionNegative": "BOOL",
        },
    },
    "MC_ReadDigitalInput": {
        "in_out": {"Input": "MC_INPUT_REF"},
        "inputs": {**_ENABLE, "InputNumber": "INT"},
        "outputs": {"Valid": "BOOL", "Busy": "BOOL", **_ERROR, "Value": "BOOL"},
    },
    "MC_ReadDigitalOutput": {
        "in_out": {"Output": "MC_OUTPUT_REF"},
        "inputs": {**_ENABLE, "OutputNumber": "INT"},
        "outputs": {"Valid": "BOOL", "Busy": "BOOL", **_ERROR, "Value": "BOOL"},
    },
    "MC_WriteDigitalOutput": {
        "in_out": {"Output": "MC_OUTPUT_REF"},
        "inputs": {**_EXECUTE, "OutputNumber": "INT", "Value": "BOOL"},
        "outputs": {"Done": "BOOL", "Busy": "BOOL", **_ERROR},
    },
    "MC_ReadAxisInfo": {
        "in_out": _AXIS,
        "inputs": _ENABLE,
        "outputs": {
            "Valid": "BOOL",
            "Busy": "BOOL",
            **_ERROR,
            "HomeAbsSwitch": "BOOL",
            "LimitSwitchPos": "BOOL",
            "LimitSwitchNeg": "BOOL",
            "Simulation": "BOOL",
            "CommunicationReady": "BOOL",
            "ReadyForPowerOn": "BOOL",
            "PowerOn": "BOOL",
            "IsHomed": "BOOL",
            "AxisWarning": "BOOL",
        },
    },
    "SMC_PI": {
        "in_out": {},
        "inputs": {
            "bEnable": "BOOL",
            **dict.fromkeys(("fSetValue", "fActValue", "fKp", "fTn", "fFeedForward"), "LREAL"),
            **dict.fromkeys(("fOutMin", "fOutMax", "fStart"), "LREAL"),
            "bHold": "BOOL",
            "fCycle": "LREAL",
        },
        "outputs": {
            "fOut": "LREAL",
            "bBusy": "BOOL",
            "bLimited": "BOOL",
            "bError": "BOOL",
            "eErrorID": "SMC_ERROR",
        },
    },
    "SMC_DigitalCamSwitch_HighPrecision": {
        "in_out": {**_AXIS, "Switches": "MC_CAMSWITCH_REF", "TrackOptions": "MC_TRACK_REF"},
        "inputs": {**_ENABLE, "EnableMask": "DWORD"},
        "outputs": {
            "InOperation": "BOOL",
            "Busy": "BOOL",
            **_ERROR,
            "Events": "ARRAY[1..32] OF SMC_CAMSWITCH_TRACK_EVENTS",
        },
    },
    "MC_CombineAxes": {
        "in_out": {"Master1": "AXIS_REF_SM3", "Master2": "AXIS_REF_SM3", "Slave": "AXIS_REF_SM3"},
        "inputs": {
            **_EXECUTE,
            "CombineMode": "MC_COMBINE_MODE",
            "GearRatioNumeratorM1": "DINT",
            "GearRatioDenominatorM1": "UDINT",
            "GearRatioNumeratorM2": "DINT",
            "GearRatioDenominatorM2": "UDINT",
            **_BUFFER,
        },
        "outputs": {"InSync": "BOOL", **_MOVED},
    },
}

STRUCTURES: dict[str, dict[str, str]] = {
    "SMC_CAMSWITCH_TOGGLE_EVENT": {
        "SwitchNumber": "UDINT",
        "ToggleEventId": "UDINT",
        "Duration": "LREAL",
        "NewValue": "BOOL",
    },
}
"""As today's SoftMotion has them."""

ENUMERATIONS: dict[str, dict[str, int]] = {
    "MC_SOURCE": {"mcCommandedValue": 0, "mcSetValue": 1, "mcActualValue": 2},
    "MC_COMBINE_MODE": {"mcAddAxes": 0, "mcSubAxes": 1},
}

PINS_ADDED: dict[str, dict[str, str]] = {
    "MC_Home": {"BufferMode": "MC_BUFFER_MODE", "Active": "BOOL"},
    "MC_MoveSuperImposed": {"CoveredDistance": "LREAL"},
    "MC_PositionProfile": {"BufferMode": "MC_BUFFER_MODE", "Active": "BOOL"},
    "MC_VelocityProfile": {"BufferMode": "MC_BUFFER_MODE", "Active": "BOOL"},
    "MC_AccelerationProfile": {"BufferMode": "MC_BUFFER_MODE", "Active": "BOOL"},
    "MC_CamIn": {
        "MasterStartDistance": "LREAL",
        "MasterSyncPosition": "LREAL",
        "BufferMode": "MC_BUFFER_MODE",
        "Active": "BOOL",
    },
}
"""Pins of blocks of the catalogs that PLCopen has, and the catalogs have not."""
