# SPDX-License-Identifier: MIT
"""Numbers that a glTF file holds in its buffers."""

import base64
import binascii
from pathlib import Path
from typing import Any
from urllib.parse import unquote

import numpy as np
from numpy.typing import NDArray

from foparq.columns import Index
from foparq.errors import UnreadableError, UnsafeError
from foparq.read.guard.paths import fit_to_read, inside
from foparq.read.mesh.gltf_json import Part
from foparq.read.mesh.made import Delivered

Numbers = NDArray[Any]

_KINDS = {5120: "<i1", 5121: "<u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
_WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}
_SHOWN = 80  #: letters of an address that a message repeats


class Buffers:
    """Buffers of a file, opened when they are asked for.

    Parameters
    ----------
    delivered : Delivered
    document : Part
        The JSON.
    inner : bytes or None
        Buffer that a GLB file holds itself.
    """

    def __init__(self, delivered: Delivered, document: Part, inner: bytes | None) -> None:
        self._delivered, self._document, self._inner = delivered, document, inner
        self._open: dict[int, bytes] = {}
        self._left = delivered.limits.bytes

    def values(self, number: int, *, real: bool) -> Numbers:
        """(n, w) numbers of an accessor, as they stand there or, of a normalised one, as they are meant.

        Parameters
        ----------
        number : int
            Of the accessor.
        real : bool
            Whether real numbers are wanted; else whole ones.

        Raises
        ------
        UnreadableError
            If it is not there, of another type, or reaches out of its buffer.
        UnsafeError
            If it has more rows than the limits allow for vertices.
        """
        accessor = self._document.at("accessors", number)
        kind = accessor.whole("componentType")
        if kind not in _KINDS or (not real and kind not in (5121, 5123, 5125)):
            raise accessor.wrong("componentType", 5126 if real else 5125)
        if accessor.text("type") not in _WIDTHS:
            raise accessor.wrong("type", '"VEC3"' if real else '"SCALAR"')
        count, width = accessor.whole("count"), _WIDTHS[accessor.text("type")]
        dtype = np.dtype(_KINDS[kind])
        if accessor.has("bufferView"):
            rows = self._rows(accessor, accessor.whole("bufferView"), count, width, dtype)
        elif accessor.has("sparse"):
            # Zeros but for some: no more of them than the file has bytes.
            self._delivered.hold_bytes("accessor", count, count, 0)
            rows = np.zeros((count, width), dtype=dtype)
        else:
            raise accessor.wrong("bufferView", 0)
        if accessor.has("sparse"):
            rows = self._replaced(rows, accessor.part("sparse"))
        if real and accessor.said.get("normalized") is True and dtype.kind in "iu":
            return np.maximum(rows / np.float64(np.iinfo(dtype).max), -1.0)
        return rows

    def count(self, number: int) -> int:
        """Rows that an accessor announces."""
        return self._document.at("accessors", number).whole("count")

    def _replaced(self, rows: Numbers, sparse: Part) -> Numbers:
        count = sparse.whole("count")
        where, what = sparse.part("indices"), sparse.part("values")
        kind = where.whole("componentType")
        if kind not in (5121, 5123, 5125):
            raise where.wrong("componentType", 5125)
        at = self._rows(where, where.whole("bufferView"), count, 1, np.dtype(_KINDS[kind]))[:, 0]
        if count and int(at.max()) >= len(rows):
            raise sparse.wrong("indices", len(rows) - 1)
        value = self._rows(what, what.whole("bufferView"), count, rows.shape[1], rows.dtype)
        rows = rows.copy()
        rows[at] = value
        return rows

    def _rows(self, asking: Part, number: int, count: int, width: int, dtype: np.dtype[Any]) -> Numbers:
        """(count, width) numbers of a buffer view; nothing is copied."""
        view = self._document.at("bufferViews", number)
        if compressed := [name for name in view.part("extensions").said if "compression" in name]:
            raise UnreadableError("mesh.gltf-compressed", file=view.file, value=compressed[0])
        size = width * dtype.itemsize
        stride = view.whole("byteStride", size)
        if stride < size:
            raise view.wrong("byteStride", size)
        begin, inner, length = view.whole("byteOffset", 0), asking.whole("byteOffset", 0), view.whole("byteLength")
        data = self._buffer(view.whole("buffer"))
        _hold(view, "byteLength", begin + length, len(data))
        need = inner + (count - 1) * stride + size if count else 0
        _hold(asking, "count" if asking.has("count") else "byteOffset", need, length)
        self._delivered.hold_vertices(count if width > 1 else count // 3)
        if not count:
            return np.empty((0, width), dtype=dtype)
        return np.ndarray((count, width), dtype, data, begin + inner, (stride, dtype.itemsize))

    def _buffer(self, number: int) -> bytes:
        if number not in self._open:
            buffer = self._document.at("buffers", number)
            data = self._opened(buffer, number)
            _hold(buffer, "byteLength", buffer.whole("byteLength"), len(data))
            self._open[number] = data
        return self._open[number]

    def _opened(self, buffer: Part, number: int) -> bytes:
        address = buffer.text("uri")
        if not buffer.has("uri"):
            if number or self._inner is None:
                raise buffer.wrong("uri", '"mesh.bin"')
            return self._inner
        if address[:5].lower() == "data:":
            head, comma, coded = address.partition(",")
            if not comma or not head.lower().endswith(";base64"):
                raise UnreadableError("mesh.gltf-data", file=buffer.file, key=buffer.where("uri"))
            try:
                return base64.b64decode(coded, validate=True)
            except (binascii.Error, ValueError):
                raise UnreadableError("mesh.gltf-data", file=buffer.file, key=buffer.where("uri")) from None
        return self._beside(buffer, address)

    def _beside(self, buffer: Part, address: str) -> bytes:
        """Bytes of a file in the folder of the mesh, or below."""
        path = inside(self._delivered.path.parent, unquote(address))
        if not path.exists():
            raise UnreadableError("mesh.gltf-buffer", file=buffer.file, key=buffer.where("uri"), value=address[:_SHOWN])
        self._left -= fit_to_read(path, self._delivered.limits.bytes)
        if self._left < 0:
            raise UnsafeError("mesh.gltf-bytes", file=buffer.file, limit=self._delivered.limits.bytes)
        return _bytes_of(path)


def _bytes_of(path: Path) -> bytes:
    try:
        return path.read_bytes()
    except PermissionError:
        raise UnreadableError("read.no-permission", file=path.name) from None


def _hold(part: Part, key: str, need: int, there: int) -> None:
    if need > there:
        raise UnreadableError("mesh.gltf-outside", file=part.file, key=part.where(key), bytes=need, left=there)


def index_of(rows: Numbers) -> Index:
    """(n,) whole numbers of an accessor of one column."""
    return rows.reshape(-1).astype(np.intp)
