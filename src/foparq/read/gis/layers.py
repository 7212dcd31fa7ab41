# SPDX-License-Identifier: MIT
"""One layer through GDAL: features as columns, with nothing believed that can be counted."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pyogrio.raw
from pyogrio.errors import CRSError, DataLayerError, DataSourceError, FeatureError, FieldError

from foparq.columns import Flags
from foparq.errors import UnsafeError
from foparq.model.drawing import Skipped
from foparq.model.items import Items
from foparq.read.gis.items import LAYER_COLUMNS, LayerRows

_PAPER_COLUMNS = ("PaperSpace", "paperspace", "PAPERSPACE")

#: what GDAL raises about a broken file
GDAL_ERRORS = (DataSourceError, DataLayerError, FeatureError, FieldError, CRSError, UnicodeDecodeError)


@dataclass(frozen=True, slots=True, kw_only=True)
class Taken:
    """What was taken from one file."""

    pieces: tuple[tuple[Items, str], ...]  #: items of each layer and its reference system
    version: str
    encoding: str
    skipped: tuple[Skipped, ...]
    layers: tuple[str, ...]  #: every layer of the file


def read_layer(name: str, layer: str | int, most: int, *, undefined: bool, called: str = "") -> LayerRows:
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
    meta, fid, wkb, values = pyogrio.raw.read(
        name, layer=layer, columns=[*LAYER_COLUMNS, *_PAPER_COLUMNS], return_fids=True, max_features=most, **options
    )
    if wkb is None:
        wkb = np.full(len(fid), None, dtype=object)
    columns = dict(zip(meta["fields"], values, strict=True))
    own = next((columns[key] for key in LAYER_COLUMNS if key in columns and columns[key].dtype == object), None)
    paper = next((columns[key] for key in _PAPER_COLUMNS if key in columns), None)
    return LayerRows(
        name=called or str(layer), geometry_type=meta["geometry_type"] or "Unknown", fid=fid, wkb=wkb, layer=own,
        system="" if undefined or not meta["crs"] else meta["crs"], paper=_flags(paper, len(fid)),
    )  # fmt: skip


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
