# SPDX-License-Identifier: MIT
"""What a drawing says of its unit, beside the unit that is used."""

from dataclasses import dataclass

import numpy as np
import shapely

from foparq.columns import Geometries, Reals
from foparq.geom.extent import boxes_of, main_box, middle
from foparq.model.drawing import Dimensions, Drawing, UnitOrigin
from foparq.model.inputs import UnitEvidence
from foparq.model.items import Role
from foparq.model.lettering import lettered_length
from foparq.units import LENGTHS, length_name

_ANGLE = "degree"  #: said of what is no length, and not said in metres
_SAME_GROUP = 0.05  #: ratios of lettered to measured length that lie nearer than this are one group
_LEAST_SHARE = 0.25  #: a smaller group is faulty lettering or a detail, not the unit of the drawing
_LETTERING = 0.01  #: relative difference that rounded lettering cannot tell apart
_EXAMPLES = 5
_STRETCH = 0.002  #: scale of a projection that no survey of a building could overlook
_SMALLEST = 0.2  #: metres across that a drawing of a building has at least
_LARGEST_DXF, _LARGEST_GIS = 500.0, 20_000.0  #: and at most: of a building, and of a town in a map
_ON_SHEET = (50.0, 100_000.0)  #: times what can be seen, that a drawing is across on its sheet
_VAGUE = 0.5  #: weight of what is merely implausible
_MATCH = 0.02  #: relative difference of a lettered number to the measured length in another unit

#: drawing unit by the factor between a lettered number and the measured length; what fits two pairs is left out
_PAIRS = {
    1000.0: "m", 100.0: "m", 10.0: "cm", 0.1: "mm", 0.01: "cm", 0.001: "mm", 12.0: "ft", 1 / 12: "in", 25.4: "in",
    2.54: "in", 0.0254: "in", 304.8: "ft", 30.48: "ft", 0.3048: "ft",
}  # fmt: skip


@dataclass(frozen=True, slots=True)
class _Statement:
    witness: str
    says: float  #: metres in one drawing unit
    weight: float
    item: str
    handle: str = ""
    layer: str = ""
    inserts: str = ""
    row: int = -1
    where: object = None


def unit_evidence(drawing: Drawing) -> UnitEvidence:
    """Statements of a drawing about its unit.

    Returns
    -------
    UnitEvidence, n rows
        In this order, each only where there is such a statement: the file's header (item ``"$INSUNITS"``, or ``"crs"``
        where the file is no DXF), unless it is what is used; one for each group of dimensions whose lettering agrees
        (item: the first of them; handle: ``"DIMENSION"``, up to five, and how many more); the projection (item
        ``"projection"``); the extent (item ``"extent"``); what other files of the delivery say (item: their path).

    Notes
    -----
    Letterings with a unit give metres. Numbers alone are used only if most of them differ from the measured length by
    one and the same factor that a single pair of units explains: 1000 is a drawing in metres lettered in millimetres,
    1 says nothing. A group of less than a quarter of the dimensions is no statement about the drawing.

    A projection that stretches lengths by more than 0.2 % contradicts the metres it is counted in. The extent speaks
    only if the drawing would be less than 0.2 m across, or more than 500 m (DXF) or 20 km (maps). Against strays, the
    larger bound looks at the middle four fifths of the items, and the smaller one leaves out the few that lie far from
    all others.
    """
    statements: list[_Statement] = []
    unit = drawing.unit
    header = "$INSUNITS" if drawing.reading.version.startswith("AC") else "crs"
    if unit.header_metres is not None and unit.origin is not UnitOrigin.HEADER:
        statements.append(_Statement("header", unit.header_metres, 0.0, header, handle=unit.header))
    if drawing.reading.dimensions is not None:
        statements.extend(_by_lettering(drawing, drawing.reading.dimensions))
    if unit.metres is not None:
        if abs(unit.stretch - 1) > _STRETCH:
            statements.append(
                _Statement("projection", unit.metres / unit.stretch, 0.0, "projection", handle=unit.header)
            )
        largest = _LARGEST_DXF if drawing.reading.version.startswith("AC") else _LARGEST_GIS
        across = _implausible(drawing, unit.metres, _SMALLEST, largest)
        if across is not None:
            plausible = _SMALLEST if across < _SMALLEST else largest
            says = unit.metres * plausible / across
            statements.append(_Statement("extent", says, _VAGUE, "extent", handle=f"{across:.3g} m"))
    statements.extend(_Statement(one.witness, one.says, 0.0, one.path) for one in drawing.heard)
    return _columns(statements, np.nan if unit.metres is None else unit.metres)


def against(drawing: Drawing, agree: float) -> dict[str, str]:
    """Independent witnesses that contradict the unit in use, and what they say, in words of the files.

    Parameters
    ----------
    agree : float
        Relative difference up to which two units are one.
    """
    evidence = unit_evidence(drawing)
    said: dict[str, str] = {}
    for row in np.flatnonzero(np.abs(evidence.says / evidence.used - 1) > np.maximum(agree, evidence.weight)):
        # A projection is what the header names.
        witness = "header" if evidence.witness[row] == "projection" else str(evidence.witness[row])
        own = witness == "extent" or evidence.handle[row] == _ANGLE
        what = evidence.handle[row] if own else length_name(float(evidence.says[row]))
        said.setdefault(witness, f"{evidence.item[row]}: {what}")
    return said


def extent_off_sheet(drawing: Drawing, visible: float) -> float:
    """Metres across a drawing that fits on no sheet, by its extent and the scale; 0 if it fits, or nobody knows.

    Parameters
    ----------
    visible : float, metres
        What is smaller cannot be seen on the sheet; 0 if the scale is unknown. A drawing is at least 50 times as large
        (1 cm of paper), and at most 100,000 times (20 m).
    """
    low, high = _ON_SHEET
    metres = drawing.unit.metres
    across = _implausible(drawing, metres, low * visible, high * visible, visible) if metres and visible > 0 else None
    return across or 0.0


def _columns(statements: list[_Statement], used: float) -> UnitEvidence:
    where: Geometries = np.empty(len(statements), dtype=object)
    for n, statement in enumerate(statements):
        where[n] = shapely.Point() if statement.where is None else statement.where
    text = {
        name: np.array([getattr(statement, name) for statement in statements], dtype=object)
        for name in ("witness", "layer", "item", "handle", "inserts")
    }
    return UnitEvidence(
        **text,
        row=np.array([statement.row for statement in statements], dtype=np.intp),
        says=np.array([statement.says for statement in statements], dtype=float),
        used=np.full(len(statements), used),
        weight=np.array([statement.weight for statement in statements], dtype=float),
        where=where,
    )


def _by_lettering(drawing: Drawing, dimensions: Dimensions) -> list[_Statement]:
    letterings = [lettered_length(text) for text in dimensions.text]
    metres = np.array([np.nan if stated is None else stated for stated, _ in letterings]) / dimensions.measured
    numbers = np.array([np.nan if number is None else number for _, number in letterings]) / dimensions.measured
    says = np.where(np.isfinite(metres), metres, _from_numbers(numbers))
    order = np.lexsort((dimensions.handle.astype(str), says))
    order = order[np.isfinite(says[order])]
    groups = np.split(order, np.flatnonzero(np.diff(np.log(says[order])) > np.log1p(_SAME_GROUP)) + 1)
    total = len(dimensions.text)
    return [_grouped(drawing, dimensions, says, group) for group in groups if len(group) > _LEAST_SHARE * total]


def _from_numbers(ratio: Reals) -> Reals:
    """(n,) metres in one drawing unit, NaN where a number alone tells nothing."""
    says = np.full(len(ratio), np.nan)
    known = np.isfinite(ratio)
    for factor, name in _PAIRS.items():
        fits = np.zeros(len(ratio), dtype=bool)
        fits[known] = np.abs(ratio[known] / factor - 1) <= _MATCH
        if 2 * np.count_nonzero(fits) > np.count_nonzero(known):
            says[fits] = LENGTHS[name]
    return says


def _grouped(drawing: Drawing, dimensions: Dimensions, says: Reals, group: np.ndarray) -> _Statement:
    by_handle = group[np.argsort(dimensions.handle[group].astype(str), kind="stable")]
    shown = by_handle[:_EXAMPLES]
    handles = "DIMENSION " + ", ".join(dimensions.handle[shown])
    more = len(group) - len(shown)
    points = shapely.get_coordinates(dimensions.where[shown], include_z=True)
    points[:, 2] = np.nan_to_num(points[:, 2])
    row = _row_of(drawing, str(dimensions.handle[by_handle[0]]))
    items = drawing.items
    return _Statement(
        witness="lettering",
        says=float(np.median(says[group])),
        weight=_LETTERING,
        item=str(items.item[row]) if row >= 0 else str(dimensions.handle[by_handle[0]]),
        handle=f"{handles} (+{more})" if more else handles,
        layer=str(items.layer[row]) if row >= 0 else "",
        inserts=str(items.inserts[row]) if row >= 0 else "",
        row=row,
        where=shapely.MultiPoint(points),
    )


def _row_of(drawing: Drawing, chain: str) -> int:
    inserts, _, handle = chain.rpartition("/")
    items = drawing.items
    rows = np.flatnonzero((items.handle == handle) & (items.inserts == inserts) & (items.role == Role.ANNOTATION))
    return int(rows[0]) if len(rows) else -1


def _implausible(
    drawing: Drawing, metres: float, smallest: float, largest: float, visible: float = 0.0
) -> float | None:
    """Metres across, if it is less or more than these metres; ``None`` if it lies between, or nothing is drawn.

    Items that are smaller than ``visible`` are not asked, unless there are no others.
    """
    seen = drawing.visible_rows() & np.isin(drawing.items.role, [Role.LINE, Role.AREA])
    boxes = boxes_of(drawing.items.geometry[seen])
    if len(boxes) == 0:
        return None
    large = (boxes[:, 3:] - boxes[:, :3]).max(axis=1) * metres >= visible
    boxes = boxes[large] if large.any() else boxes
    low, high = main_box(boxes)
    together = float((high - low).max()) * metres
    if together == 0:
        return None
    if together < smallest:
        return float(together)
    low, high = middle(boxes)
    spread = float(np.max(high - low)) * metres
    return spread if spread > largest else None
