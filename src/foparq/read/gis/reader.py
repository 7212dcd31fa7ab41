# SPDX-License-Identifier: MIT
"""GeoPackage, Shapefile and GeoJSON through GDAL, as little of it as possible.

Rows become items by these rules:

- One item a part of a feature. ``item`` is ``"table:fid"`` in a GeoPackage, ``"fid"`` elsewhere, with ``".part"`` added
  where a feature has several parts; ``handle`` is the feature id as written.
- ``layer`` is the name of the table. Where the table has a text column called ``layer`` or ``camada``, as CAD programs
  export it, its value is the layer; rows without a value keep the name of the table. Names that differ in case only, or
  in how accents are composed, are one layer.
- Rows of a CAD export with ``PaperSpace`` true are in paper space; what they are is told by :mod:`foparq.read.gis.cad`.
- A feature without geometry stays, with ``None``. Measures (M) are dropped, heights are kept, nothing is repaired.
- Arcs become chords of the stated sagitta.
"""

import mmap
import re
import warnings
from collections import Counter
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import shapely
from pyogrio.errors import GeometryError

from foparq.errors import UnreadableError, UnsafeError
from foparq.model.drawing import Labels, Reading, Repair, Skipped, SkippedReason, StatedScale
from foparq.model.items import Items, Role
from foparq.names import folded
from foparq.profile.schema import LimitsSpec
from foparq.read.gis.companions import companions
from foparq.read.gis.crs import describe, unit_of
from foparq.read.gis.dbf import Encoding, encoding_of_dbf
from foparq.read.gis.gpkg import read_gpkg
from foparq.read.gis.items import Piece, items_of, join_items
from foparq.read.gis.layers import GDAL_ERRORS, Taken, first_line, hold, read_layer
from foparq.read.guard.paths import name_of
from foparq.read.guard.sniff import Format, format_of
from foparq.read.guard.stage import staged
from foparq.read.lettering import LONGEST_NAME, LONGEST_SCALE, MOST_NAMES, scales_in
from foparq.read.letters import garbled
from foparq.read.raw import RawDrawing, holds_drawing

_READ = (".shx", ".dbf", ".prj", ".cpg")  #: companions that what is read depends on
_MOST_COLUMNS = 2_000  #: as in SQLite, and so in a GeoPackage
_JSON_NAME = re.compile(rb'"([^"\\]*+)"\s*+:')
_SHX_HEADER, _SHX_RECORD = 100, 8  #: bytes
_ELSE = "iso8859-1"  #: in which GDAL reads what nobody names


def read_gis(
    path: Path, *, limits: LimitsSpec, sagitta: float, unit: str | None, layers: tuple[str, ...]
) -> RawDrawing:
    """Drawing of a GeoPackage, Shapefile or GeoJSON file.

    Parameters
    ----------
    path : Path
        A regular file; for a Shapefile the ``.shp``, with its companions beside it.
    limits : LimitsSpec
        Features and vertices beyond which the file is refused.
    sagitta : float, metres
        Greatest distance between an arc and the chords that replace it. If nobody says what a drawing unit is, one
        ten-thousandth of each arc's radius instead. Only GeoPackages hold arcs.
    unit : str or None
        Unit as stated by the user; it wins over the reference system.
    layers : tuple of str
        Tables of a GeoPackage to read; all if empty. Other formats have one.

    Raises
    ------
    UnreadableError
        If the file is broken, incomplete, or of another format.
    UnsafeError
        If it holds more than the limits allow, or runs programs.
    ManifestError
        If a table is asked for that is not there.
    """
    kind = format_of(path)
    with warnings.catch_warnings():
        # Dropped measures and fields without a type: nothing that is read depends on them.
        warnings.simplefilter("ignore")
        if kind is Format.GPKG:
            taken = read_gpkg(path, limits=limits, sagitta=sagitta, unit=unit, wanted=layers)
        elif kind is Format.SHAPEFILE:
            taken = _read_shapefile(path, limits)
        elif kind is Format.GEOJSON:
            taken = _read_geojson(path, limits)
        else:
            raise UnreadableError("read.not-gis", file=path.name, value=kind.value)
    items = _one_spelling(join_items([piece.items for piece in taken.pieces]), taken.layers)
    hold(path, "read.too-many-vertices", int(shapely.get_num_coordinates(items.geometry).sum()), limits.vertices)
    systems = tuple(dict.fromkeys(piece.system for piece in taken.pieces if len(piece.items)))
    names = dict.fromkeys([*taken.layers, *items.layer.tolist()])
    reading = Reading(
        version=taken.version,
        encoding=taken.encoding,
        repairs=taken.repairs,
        skipped=(*taken.skipped, *_on_paper(items)),
        bad_names=tuple(name for name in names if garbled(name, taken.encoding)),
        labels=_labels(taken.pieces),
        scales=_scales(taken.pieces),
        layers=taken.layers,
        crs=", ".join(describe(text) for text in systems if text),
    )
    return RawDrawing(items=items, reading=reading, unit=unit_of(systems or ("",), _bounds(items), unit))


def _one_spelling(items: Items, tables: Sequence[str]) -> Items:
    """Items whose layers are one where their names differ in case or in how accents are composed, as in CAD.

    The spelling of a table wins, else the first in order of letters, whatever the order of the rows.
    """
    names = set(items.layer.tolist())
    spelt: dict[str, str] = {}
    for name in (*tables, *sorted(names)):
        spelt.setdefault(folded(name), name)
    if all(spelt[folded(name)] == name for name in names):
        return items
    layer = items.layer.copy()
    layer[:] = [spelt[folded(name)] for name in items.layer.tolist()]
    return replace(items, layer=layer)


def _on_paper(items: Items) -> tuple[Skipped, ...]:
    # A CAD export keeps the sheet among its rows: a frame, unless nothing else is drawn.
    frame = SkippedReason.PAPER_SPACE if holds_drawing(items) else SkippedReason.PAPER_SPACE_ONLY
    lettered = items.role[items.paper] == Role.ANNOTATION
    reasons = np.where(lettered, SkippedReason.PAPER_SPACE.value, frame.value).tolist()
    columns = (items.kind[items.paper].tolist(), items.layer[items.paper].tolist())
    found = Counter(zip(reasons, *columns, strict=True))
    return tuple(
        Skipped(reason=SkippedReason(reason), kind=kind, layer=layer, count=count)
        for (reason, kind, layer), count in sorted(found.items())
    )


def _labels(pieces: Sequence[Piece]) -> Labels | None:
    """Letterings of a CAD export that may name a point."""
    if not any(len(piece.words) for piece in pieces):
        return None
    words = np.concatenate([piece.words[~piece.on_sheet] for piece in pieces])
    places = np.concatenate([piece.places[~piece.on_sheet] for piece in pieces])
    short = np.array([len(text) <= LONGEST_NAME for text in words.tolist()], dtype=bool)
    chosen = np.flatnonzero(short)[:MOST_NAMES]
    return Labels(text=words[chosen], place=places[chosen], block=np.zeros(len(chosen), dtype=bool))


def _scales(pieces: Sequence[Piece]) -> tuple[StatedScale, ...]:
    said = {text for piece in pieces for text in piece.words.tolist() if len(text) <= LONGEST_SCALE}
    found = {scale for text in said for scale in scales_in(text)}
    return tuple(sorted(found, key=lambda one: (one.said, one.denominator)))


def _read_shapefile(path: Path, limits: LimitsSpec) -> Taken:
    beside = companions(path, limits.bytes)
    missing = [ending for ending in (".shx", ".dbf") if ending not in beside]
    if missing:
        raise UnreadableError(
            "read.shp-incomplete", file=path.name, value=" ".join(missing), example=path.with_suffix(missing[0]).name
        )
    _same_rows(path, beside)
    encoding = encoding_of_dbf(beside[".dbf"], beside.get(".cpg"))
    # GDAL would open whatever else has a fitting name.
    files = {"drawing.shp": path, **{f"drawing{ending}": beside[ending] for ending in _READ if ending in beside}}
    with staged(files) as link:
        taken = _single(
            path, str(link), limits, undefined=".prj" not in beside, version="ESRI Shapefile", encoding=encoding
        )
    if not encoding.unknown:
        return taken
    return replace(taken, repairs=(Repair(code="code-page-unknown", kind=".cpg", text=encoding.stated, detail=_ELSE),))


def _same_rows(path: Path, beside: dict[str, Path]) -> None:
    # The index says how many shapes are read: one of another day would lose some without a word.
    shapes = (beside[".shx"].stat().st_size - _SHX_HEADER) // _SHX_RECORD
    with beside[".dbf"].open("rb") as stream:
        head = stream.read(12)
    # Number of rows, bytes of the header, bytes of a row; rows that are cut off do not count.
    stated, start, width = (int.from_bytes(head[a:b], "little") for a, b in ((4, 8), (8, 10), (10, 12)))
    rows = min(stated, max(beside[".dbf"].stat().st_size - start, 0) // max(width, 1))
    if shapes != rows:
        raise UnreadableError("read.shp-mismatch", file=path.name, value=shapes, other=rows)


def _hold_names(path: Path) -> None:
    # Every name of a property anywhere becomes a column of the whole table: the cost grows with the square.
    names: set[bytes] = set()
    with path.open("rb") as stream, mmap.mmap(stream.fileno(), 0, access=mmap.ACCESS_READ) as text:
        for found in _JSON_NAME.finditer(text):
            names.add(found[1])
            if len(names) > _MOST_COLUMNS:
                raise UnsafeError("read.too-many-columns", file=path.name, limit=_MOST_COLUMNS)


def _read_geojson(path: Path, limits: LimitsSpec) -> Taken:
    _hold_names(path)
    with staged({"drawing.geojson": path}) as link:
        return _single(
            path, f"GeoJSON:{link}", limits, undefined=False, version="GeoJSON", encoding=Encoding("UTF-8", "")
        )


def _single(path: Path, name: str, limits: LimitsSpec, *, undefined: bool, version: str, encoding: Encoding) -> Taken:
    # Formats of one layer. One feature more than allowed is asked for, so that too many are noticed.
    try:
        layer = read_layer(
            name, 0, limits.entities + 1, undefined=undefined, called=name_of(path.stem), encoding=encoding
        )
    except (GeometryError, *GDAL_ERRORS) as error:
        raise UnreadableError("read.gis-broken", file=path.name, value=first_line(error)) from None
    hold(path, "read.too-many-items", len(layer.fid), limits.entities)
    piece = items_of(layer, prefix="")
    return Taken(
        pieces=(piece,),
        version=version,
        encoding=encoding.name.upper() or encoding.stated,
        skipped=piece.skipped,
        layers=(layer.name,),
    )


def _bounds(items: Items) -> tuple[float, float, float, float]:
    # Infinite coordinates are a fault of one item and say nothing of the drawing.
    points = shapely.get_coordinates(items.geometry)
    points = points[np.isfinite(points).all(axis=1)]
    if not len(points):
        return (np.nan, np.nan, np.nan, np.nan)
    (xmin, ymin), (xmax, ymax) = points.min(axis=0).tolist(), points.max(axis=0).tolist()
    return xmin, ymin, xmax, ymax
