# SPDX-License-Identifier: MIT
"""LAS and LAZ, read by laspy where it is installed."""

import struct
from pathlib import Path

import numpy as np

from foparq.errors import UnreadableError
from foparq.model.cloud import RawCloud
from foparq.profile.schema import LimitsSpec
from foparq.read.cloud.held import cloud_of, hold_points

_CHUNK = 1_000_000  #: points that are unpacked at once
_HEAD = 375  #: bytes of the longest header
_RECORD = 54  #: bytes of the head of a record of variable length
_COMPRESSED = 0x80  #: bit of the format of the points
#: what laspy, lazrs and numpy raise at bytes that are none of theirs
_BROKEN = (ValueError, OverflowError, LookupError, EOFError, OSError, RuntimeError, struct.error, TypeError,
           AttributeError, ArithmeticError)  # fmt: skip


def read_las(path: Path, limits: LimitsSpec) -> RawCloud:
    """Cloud of a LAS or LAZ file.

    Raises
    ------
    UnreadableError
        If laspy is not installed, or the file is broken or cut off.
    UnsafeError
        If it announces more points than the limits allow.

    Notes
    -----
    O(n). What the header announces is compared with the size of the file before anything is made of it.
    """
    try:
        import laspy  # noqa: PLC0415 - an extra: nothing else needs it
    except ImportError:
        raise UnreadableError("cloud.las-extra", file=path.name, example='pip install "foparq[clouds]"') from None
    _hold(path, limits)
    try:
        # One thread: a pool of threads does not live on in a forked child.
        with laspy.open(path, laz_backend=laspy.LazBackend.Lazrs) as stream:
            count = int(stream.header.point_count)
            hold_points(path.name, count, limits)
            points = np.empty((count, 3))
            at = 0
            for chunk in stream.chunk_iterator(_CHUNK):
                taken = points[at : at + len(chunk)]
                for axis, column in enumerate((chunk.x, chunk.y, chunk.z)):
                    taken[:, axis] = column
                at += len(chunk)
            version = f"LAS {stream.header.version}"
    except (*_BROKEN, laspy.errors.LaspyException) as error:
        raise UnreadableError("cloud.las-broken", file=path.name, value=str(error)[:80]) from None
    if at != count:
        raise UnreadableError("cloud.cut-off", file=path.name, value=count, other=at)
    return cloud_of(path.name, points, version)


def _hold(path: Path, limits: LimitsSpec) -> None:
    """Refuse announcements that the file cannot keep: laspy would believe them."""
    size = path.stat().st_size
    with path.open("rb") as stream:
        head = stream.read(_HEAD).ljust(_HEAD, b"\0")
    start, begin, records = struct.unpack_from("<HII", head, 94)
    form, width, count = struct.unpack_from("<BHI", head, 104)
    newer = head[24] == 1 and head[25] >= 4  # noqa: PLR2004 - version 1.4 has wider counts
    behind = 0
    if newer:
        behind = int.from_bytes(head[243:247], "little")
        count = int.from_bytes(head[247:255], "little")
    if begin > size or start + _RECORD * records > begin or _RECORD * behind > size:
        raise UnreadableError("cloud.las-broken", file=path.name, value="header")
    if not form & _COMPRESSED and begin + width * count > size:
        raise UnreadableError("cloud.cut-off", file=path.name, value=count, other=max(size - begin, 0) // max(width, 1))
    hold_points(path.name, count, limits)
