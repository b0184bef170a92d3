"""Numbers of address letters in SMC_GCODE_WORD.byLetter: ASCII, longer addresses have numbers of their own.

The same numbers are `GCodeLetter` of the library SM3_CNC; described in docs/cnc-data.md.
"""

AXES = "XYZABCPQUVW"
"""Axes of a path in the order of their bits in wAuxData."""

END_OF_BLOCK = 0
SKIP = ord("/")
FIRST_VELOCITY = 128
FIRST_ACCELERATION = 144
REFUSED = 254
END_OF_PROGRAM = 255

LETTERS: dict[str, int] = {
    **{chr(code): code for code in range(ord("A"), ord("Z") + 1)},
    **{f"F{axis}": FIRST_VELOCITY + index for index, axis in enumerate(AXES)},
    "FF": FIRST_VELOCITY + len(AXES),
    **{f"E{axis}": FIRST_ACCELERATION + index for index, axis in enumerate(AXES)},
    "EF": FIRST_ACCELERATION + len(AXES),
    "PROBE": 160,
}
"""Address of a word to its number."""

ADDRESSES = {code: address for address, code in LETTERS.items()}
