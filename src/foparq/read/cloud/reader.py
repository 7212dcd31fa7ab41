# SPDX-License-Identifier: MIT
"""A cloud of points of any format that foparq reads, told by its content."""

import sys
from pathlib import Path

from foparq.errors import UnreadableError
from foparq.model.cloud import RawCloud
from foparq.profile.schema import LimitsSpec
from foparq.read.cloud.held import cloud_of, hold_points
from foparq.read.guard.paths import fit_to_read
from foparq.read.guard.sniff import CloudFormat, cloud_format_of
from foparq.read.mesh.made import Delivered
from foparq.read.mesh.ply import read_ply_points


def read_cloud(path: Path, *, limits: LimitsSpec) -> RawCloud:
    """Points of a file as they stand there.

    Parameters
    ----------
    path : Path
        A regular file: PLY (of one with faces its vertices), LAS, LAZ, or a text with a point in each line.
    limits : LimitsSpec
        Bytes and points beyond which the file is refused.

    Returns
    -------
    RawCloud

    Raises
    ------
    UnreadableError
        If the file is broken, cut off, of another format, or no point of it has coordinates.
    UnsafeError
        If it holds more than the limits allow.
    """
    fit_to_read(path, limits.bytes)
    kind = cloud_format_of(path)
    if kind is CloudFormat.LAS:
        from foparq.read.cloud.las import read_las  # noqa: PLC0415 - laspy is an extra

        return read_las(path, limits)
    if kind is CloudFormat.PLY:
        # A cloud has a bound of its own, whatever a mesh may have.
        bounds = limits.model_copy(update={"faces": sys.maxsize})
        points, version = read_ply_points(Delivered(path, path.read_bytes(), bounds))
        hold_points(path.name, len(points), limits)
        return cloud_of(path.name, points, version)
    from foparq.read.cloud.text import read_text_cloud  # noqa: PLC0415 - only texts need it

    points = read_text_cloud(path, limits)
    if not len(points):
        raise UnreadableError("cloud.no-points", file=path.name, value=0)
    return cloud_of(path.name, points, "text")
