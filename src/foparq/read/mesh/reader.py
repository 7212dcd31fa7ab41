# SPDX-License-Identifier: MIT
"""A mesh of any format that foparq reads."""

from pathlib import Path

from foparq.model.mesh import RawMesh
from foparq.profile.schema import LimitsSpec
from foparq.read.guard.paths import fit_to_read
from foparq.read.guard.sniff import MeshFormat, mesh_format_of
from foparq.read.mesh.gltf import read_glb, read_gltf
from foparq.read.mesh.made import Delivered
from foparq.read.mesh.obj import read_obj
from foparq.read.mesh.off import read_off
from foparq.read.mesh.ply import read_ply
from foparq.read.mesh.stl import read_stl

_READERS = {
    MeshFormat.GLB: read_glb,
    MeshFormat.GLTF: read_gltf,
    MeshFormat.OBJ: read_obj,
    MeshFormat.OFF: read_off,
    MeshFormat.PLY: read_ply,
    MeshFormat.STL: read_stl,
}


def read_mesh(path: Path, *, limits: LimitsSpec) -> RawMesh:
    """Surface of a mesh file as it stands there: no vertex is merged, no face is left out, no number is changed.

    Parameters
    ----------
    path : Path
        A regular file: PLY, OBJ, STL, OFF, glTF, GLB or DXF, told from its content. Libraries of materials that an OBJ
        names, and buffers of a glTF file, are read from the same folder or below.
    limits : LimitsSpec
        Bytes, faces and vertices (as many as faces) beyond which the file is refused.

    Returns
    -------
    RawMesh
        Coordinates in the unit of the file; of a glTF file those of the scene. Vertices that are no numbers, corners
        that name a vertex that is not there, and faces of less than three corners are in it as in the file.

    Raises
    ------
    UnreadableError
        If the file is broken, cut off, of another format, or has no face.
    UnsafeError
        If it holds more than the limits allow, or names a buffer outside its folder.

    Notes
    -----
    O(n). Nothing is allocated on the word of a header: what it announces is compared with the size of the file.
    """
    fit_to_read(path, limits.bytes)
    kind = mesh_format_of(path)
    if kind is MeshFormat.DXF:
        # Others are read without loading ezdxf, which takes longer than a small mesh.
        from foparq.read.mesh.dxf import read_dxf_mesh  # noqa: PLC0415

        return read_dxf_mesh(Delivered(path, b"", limits))
    return _READERS[kind](Delivered(path, path.read_bytes(), limits))
