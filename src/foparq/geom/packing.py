# SPDX-License-Identifier: MIT
"""Columns made small and quick to pickle: one buffer instead of a million objects."""

import numpy as np
import shapely

from foparq.columns import Geometries, Texts

Packed = tuple[object, ...]

_NOTHING = -1  #: length of a geometry that is ``None``
_SEPARATOR = "\0"


def pack_geometry(geometry: Geometries) -> Packed:
    """Well-known binary of n geometries as one buffer and their lengths.

    Parameters
    ----------
    geometry : (n,) shapely geometries or ``None``

    Returns
    -------
    tuple = (bytes, (n,) int64)
        Three-dimensional geometries stay so. Linear rings become lines: well-known binary does not tell them apart.
    """
    pieces = shapely.to_wkb(geometry, output_dimension=3).tolist()
    lengths = np.fromiter((_NOTHING if piece is None else len(piece) for piece in pieces), np.int64, len(pieces))
    return b"".join(piece for piece in pieces if piece is not None), lengths


def unpack_geometry(packed: Packed) -> Geometries:
    """Inverse of :func:`pack_geometry`."""
    data, lengths = packed
    assert isinstance(data, bytes)  # noqa: S101 - narrows the type
    assert isinstance(lengths, np.ndarray)  # noqa: S101
    ends = np.cumsum(np.maximum(lengths, 0))
    pieces: Geometries = np.empty(len(lengths), dtype=object)
    pieces[:] = [
        data[end - length : end] if length >= 0 else None
        for length, end in zip(lengths.tolist(), ends.tolist(), strict=True)
    ]
    with np.errstate(invalid="ignore"):  # NaN coordinates are delivered as they are
        geometry: Geometries = shapely.from_wkb(pieces, on_invalid="ignore")
    return geometry


def pack_texts(column: Texts) -> Packed:
    """Texts as few distinct ones with codes, or joined, or as they are.

    Parameters
    ----------
    column : (n,) str

    Returns
    -------
    tuple
        To be read by :func:`unpack_texts` only.
    """
    texts = column.tolist()
    distinct = dict.fromkeys(texts)
    if len(distinct) <= len(texts) // 4:
        code = {text: number for number, text in enumerate(distinct)}
        return "codes", list(distinct), np.fromiter(map(code.__getitem__, texts), np.int32, len(texts))
    if all(isinstance(text, str) for text in texts):
        joined = _SEPARATOR.join(texts)
        if joined.count(_SEPARATOR) == len(texts) - 1:
            return "joined", joined
    return "plain", column


def unpack_texts(packed: Packed) -> Texts:
    """Inverse of :func:`pack_texts`."""
    how, first, *rest = packed
    if how == "codes":
        codes = rest[0]
        assert isinstance(first, list)  # noqa: S101 - narrows the type
        assert isinstance(codes, np.ndarray)  # noqa: S101
        distinct: Texts = np.empty(len(first), dtype=object)
        distinct[:] = first
        return distinct[codes]
    if how == "joined":
        return np.array(str(first).split(_SEPARATOR), dtype=object)
    assert isinstance(first, np.ndarray)  # noqa: S101 - narrows the type
    return first
