"""What the variables of a cam hold: members of MC_CAM_REF, of its elements and of its tappets (CAM-90)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from tappet.project.cams.elements import by_bend, equidistant, xyva_points
from tappet.project.cams.table import LAWS, CamPoint, CamSegment, CamTable, CompileFormat
from tappet.project.cams.tappets import entries

Member = float | list[float] | list[list[float]]
"""A number, also of an enumeration, or the positions of a table: of the slave, or pairs."""
Row = Mapping[str, Member]
BY_TYPE: Mapping[CompileFormat, int] = {
    "one_dimensional": 1,
    "two_dimensional": 2,
    "polynomial": 3,
    "segments": 4,
}
"""MC_CAM_REF.byType."""
ELEMENTS: Mapping[CompileFormat, str] = {"polynomial": "SMC_CAMXYVA", "segments": "SMC_CAM_SEGMENT"}
"""Types of elements; each size of a table is a type of its own."""


@dataclass(frozen=True, slots=True)
class CamVariables:
    """Values by the names of members."""

    cam: Row
    """Of MC_CAM_REF: those that an edit changes."""
    elements: tuple[Row, ...]
    """Points, segments, or the one table."""
    tappets: tuple[Row, ...]


def variables_of(cam: CamTable) -> CamVariables:
    """The variables that a cam is compiled into."""
    elements = _elements(cam)
    tappets = tuple(
        {"ctt": direction, "cta": action, "iGroupID": id, "x": x}
        for track in cam.tracks
        for tappet in track.tappets
        for id, x, direction, action in entries(track.id, tappet)
    )
    first, last = cam.domain
    count = cam.table_size if is_table(cam) else len(elements)
    facts: Row = {"nElements": count, "xStart": first, "xEnd": last, "nTappets": len(tappets)}
    if is_table(cam):
        facts = {**facts, "byInterpolationQuality": 3 if cam.cubic else 1}
    return CamVariables(facts, elements, tappets)


def is_table(cam: CamTable) -> bool:
    """Whether it is compiled into positions between which the library interpolates."""
    return cam.compile_format in ("one_dimensional", "two_dimensional")


def _elements(cam: CamTable) -> tuple[Row, ...]:
    if cam.compile_format == "polynomial":
        return tuple({"dX": p.x, "dY": p.y, "dV": p.v, "dA": p.a} for p in xyva_points(cam))
    if cam.compile_format == "segments":
        return tuple(_segment(*piece) for piece in cam.pieces())
    return (_table(cam),)


def _segment(left: CamPoint, segment: CamSegment, right: CamPoint) -> Row:
    ends: Row = {
        f"d{name.upper()}{end}": getattr(point, name)
        for end, point in enumerate((left, right))
        for name in "xyvaj"
    }
    return {**ends, "dLambda": segment.inflection, "eType": LAWS.index(segment.law)}


def _table(cam: CamTable) -> Row:
    """A table in the units of the editor; the slave's ranges only have to be equal and not empty."""
    table: list[float] | list[list[float]]
    if cam.compile_format == "two_dimensional":
        table = [[x, y] for x, y in by_bend(cam, cam.table_size)]
    else:
        table = [y for _, y in equidistant(cam, cam.table_size)]
    first, last = cam.domain
    limits = {
        f"f{units}{axis}{end}": value
        for units in ("Editor", "Table")
        for axis, ends in (("Master", (first, last)), ("Slave", (0.0, 1.0)))
        for end, value in zip(("Min", "Max"), ends, strict=True)
    }
    return {"Table": table, **limits}
