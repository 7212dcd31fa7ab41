# SPDX-License-Identifier: MIT
"""One layer through GDAL: features as columns, with nothing believed that can be counted."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pyogrio.raw
from pyogrio.errors import CRSError, DataLayerError, DataSourceError, FeatureError, FieldError

from foparq.columns import Flags, Texts
from foparq.errors import UnsafeError
from foparq.model.drawing import Repair, Skipped
from foparq.read.gis.cad import CadColumns
from foparq.read.gis.columns import CAD_COLUMNS, LAYER_COLUMNS, PAPER_COLUMNS, READ_COLUMNS
from foparq.read.gis.dbf import Encoding
from foparq.read.gis.items import LayerRows, Piece

_BYTES = "ISO-8859-1"  #: in which every byte is a letter

#: what GDAL raises about a broken file
GDAL_ERRORS = (DataSourceError, DataLayerError, FeatureError, FieldError, CRSError, UnicodeDecodeError)


@dataclass(frozen=True, slots=True, kw_only=True)
class Taken:
    """What was taken from one file."""

    pieces: tuple[Piece, ...]  #: one for each layer
    version: str
    encoding: str
    skipped: tuple[Skipped, ...]
    layers: tuple[str, ...]  #: every layer of the file
    repairs: tuple[Repair, ...] = ()


def read_layer(
    name: str, layer: str | int, most: int, *, undefined: bool, called: str = "", encoding: Encoding | None = None
) -> LayerRows:
    """One layer.

    Parameters
    ----------
    name : str
        File as GDAL is to open it, with the prefix of its driver where that has one.
    layer : str or int
        Name or number of the layer.
    most : int
        Features that are read at most.
    undefined : bool
        True if the file is known to say nothing of its reference system.
    called : str
        Name of the layer for people; that of the table if left out.
    encoding : Encoding, optional
        Of its texts; GDAL chooses where it has no name, and knows few names.

    Raises
    ------
    pyogrio.errors.GeometryError
        If the layer is declared of a type that is no simple feature.
    Exception
        One of :data:`GDAL_ERRORS` if the file is broken.
    """
    # A condition that is always true makes GDAL count rows instead of believing the file's own count.
    strict = {"where": "1 = 1", "IMMUTABLE": "YES", "NOLOCK": "YES", "LIST_ALL_TABLES": "NO"}
    options: dict[str, Any] = strict if name.startswith("GPKG:") else {}
    codec = encoding.name if encoding is not None else ""
    meta, fid, wkb, values = pyogrio.raw.read(
        name,
        layer=layer,
        columns=READ_COLUMNS,
        return_fids=True,
        max_features=most,
        encoding=_BYTES if codec else None,
        **options,
    )
    if codec:
        values = [_decoded(column, codec) if column.dtype == object else column for column in values]
    if wkb is None:
        wkb = np.full(len(fid), None, dtype=object)
    columns = dict(zip(meta["fields"], values, strict=True))
    own = _texts(columns, LAYER_COLUMNS)
    cad = None if own is None else _cad(columns, len(fid))
    return LayerRows(
        name=called or str(layer), geometry_type=meta["geometry_type"] or "Unknown", fid=fid, wkb=wkb, layer=own,
        system="" if undefined or not meta["crs"] else meta["crs"], cad=cad,
        paper=_flags(next((columns[key] for key in PAPER_COLUMNS if key in columns), None), len(fid)),
    )  # fmt: skip


def _decoded(column: Texts, codec: str) -> Texts:
    """Texts that were read byte by byte; bytes that mean nothing are shown as U+FFFD."""
    texts = column.copy()
    texts[:] = [
        text.encode(_BYTES).decode(codec, "replace") if isinstance(text, str) else text for text in column.tolist()
    ]
    return texts


def _texts(columns: dict[str, Any], names: tuple[str, ...]) -> Texts | None:
    return next((columns[key] for key in names if key in columns and columns[key].dtype == object), None)


def _cad(columns: dict[str, Any], n: int) -> CadColumns | None:
    """Columns of a CAD export; ``None`` if the table is none."""
    found = {key: _texts(columns, names) for key, names in CAD_COLUMNS.items()}
    if found["subclasses"] is None and found["handle"] is None:
        return None
    none: Texts = np.full(n, None, dtype=object)
    return CadColumns(**{key: none if column is None else column for key, column in found.items()})


def _flags(column: np.ndarray | None, n: int) -> Flags:
    if column is None:
        return np.zeros(n, dtype=bool)
    return np.array([value in (True, 1, "1", "true") for value in column.tolist()], dtype=bool)


def hold(path: Path, message: str, count: int, limit: int) -> None:
    """Raise :class:`UnsafeError` if a file holds more than is allowed."""
    if count > limit:
        raise UnsafeError(message, file=path.name, value=count, limit=limit)


def first_line(error: Exception) -> str:
    """First line of what a library says, shortened."""
    return (str(error).splitlines() or [type(error).__name__])[0][:200]
