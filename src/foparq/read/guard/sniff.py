# SPDX-License-Identifier: MIT
"""What a file is, told from its first bytes and never from its name."""

import re
from enum import StrEnum
from pathlib import Path

from foparq.errors import InputError, UnreadableError

_HEAD = 8192


class Format(StrEnum):
    """Formats of drawings that foparq reads."""

    DXF = "dxf"
    GPKG = "gpkg"
    SHAPEFILE = "shapefile"
    GEOJSON = "geojson"


class MeshFormat(StrEnum):
    """Formats of meshes that foparq reads."""

    DXF = "dxf"
    GLB = "glb"
    GLTF = "gltf"
    OBJ = "obj"
    OFF = "off"
    PLY = "ply"
    STL = "stl"


class CloudFormat(StrEnum):
    """Formats of clouds of points that foparq reads."""

    LAS = "las"
    PLY = "ply"
    TEXT = "text"


_MAGIC = (
    (b"AutoCAD Binary DXF\r\n\x1a\x00", Format.DXF),
    (b"SQLite format 3\x00", Format.GPKG),
    (b"\x00\x00\x27\x0a", Format.SHAPEFILE),
)
_ARCHIVES = (
    (b"PK\x03\x04", "ZIP"), (b"PK\x05\x06", "ZIP"), (b"Rar!\x1a\x07", "RAR"), (b"7z\xbc\xaf\x27\x1c", "7z"),
    (b"\x1f\x8b", "gzip"), (b"BZh", "bzip2"), (b"\xfd7zXZ\x00", "xz"),
)  # fmt: skip
_OTHERS = (
    (b"%PDF-", "PDF"), (b"\x89PNG", "PNG"), (b"\xff\xd8\xff", "JPEG"), (b"II*\x00", "TIFF"), (b"MM\x00*", "TIFF"),
    (b"GIF8", "GIF"), (b"ply\n", "PLY"), (b"ply\r", "PLY"), (b"\xd0\xcf\x11\xe0", "DGN/Office"), (b"<", "XML"),
)  # fmt: skip
_NO_MESHES = (
    (b"Kaydara FBX", "FBX"), (b"; FBX", "FBX"), (b"BLENDER", "Blender"), (b"LASF", "LAS"), (b"ASTM-E57", "E57"),
    (b"PXR-USDC", "USD"), (b"#usda", "USD"), (b"# .PCD", "PCD"), (b"#VRML", "VRML"), *_OTHERS,
)  # fmt: skip
_PLY = re.compile(rb"^ply[ \t]*[\r\n]")
_OFF = re.compile(rb"^(?:[ \t]*#[^\r\n]*[\r\n]|[ \t\r\n])*+(?:ST)?C?N?4?n?OFF(?=[ \t\r\n#])")
#: a line of an OBJ; a file that begins with a long comment has none in its head
_OBJ = re.compile(rb"(?:^|[\r\n])[ \t]*(?:#|(?:v|vt|vn|vp|f|o|g|s|l|p|mtllib|usemtl)[ \t])")
_SUFFIXES = frozenset({".ply", ".obj", ".stl", ".off", ".glb", ".gltf"})  #: of a mesh that tells nothing itself
#: one of the parts of a glTF stands in its head
_GLTF = (b'"asset"', b'"accessors"', b'"buffers"', b'"bufferViews"', b'"meshes"', b'"nodes"', b'"scenes"')
_STL_HEADER, _STL_FACET = 84, 50  #: bytes
_DWG = re.compile(rb"^AC(1\.|[12]0)\d")
#: a DXF in text: group code 0 and SECTION, perhaps after comments (999) and dirt
_DXF = re.compile(rb"(^|[\r\n])[ \t]*0[ \t]*\r?\n[ \t]*SECTION[ \t]*(\r?\n|$)")


def format_of(path: Path) -> Format:
    """Format of a drawing.

    Parameters
    ----------
    path : Path
        A regular file.

    Raises
    ------
    UnreadableError
        If the file is empty, an archive, a DWG, or nothing that foparq reads; the error says which.
    """
    with path.open("rb") as stream:
        head = stream.read(_HEAD)
    if not head:
        raise UnreadableError("read.empty", file=path.name)
    text = head.removeprefix(b"\xef\xbb\xbf").lstrip()
    archive, other = _named(head, _ARCHIVES), _named(text, _OTHERS)
    if known := _named(head, _MAGIC):
        return Format(known)
    if _DWG.match(head):
        raise UnreadableError("read.dwg", file=path.name, value=head[:6].decode("ascii", "replace"))
    if archive:
        raise UnreadableError("read.archive", file=path.name, value=archive)
    if _DXF.search(head):
        return Format.DXF
    if text.startswith(b"{"):
        return Format.GEOJSON
    if other:
        raise UnreadableError("read.pdf" if other == "PDF" else "read.not-a-drawing", file=path.name, value=other)
    raise UnreadableError("read.unknown-format", file=path.name)


def mesh_format_of(path: Path) -> MeshFormat:
    """Format of a mesh.

    Parameters
    ----------
    path : Path
        A regular file.

    Raises
    ------
    UnreadableError
        If the file is empty, an archive, or nothing that foparq reads as a mesh; the error says which.

    Notes
    -----
    A binary STL is told by its size, which follows from its number of facets: its first bytes are a free text, often
    "solid". Only where that number is false does the name of the file tell that an STL was meant.
    """
    with path.open("rb") as stream:
        head = stream.read(_HEAD)
    if not head:
        raise UnreadableError("read.empty", file=path.name)
    size = path.stat().st_size
    facets = int.from_bytes(head[_STL_HEADER - 4 : _STL_HEADER], "little")
    if size >= _STL_HEADER and size == _STL_HEADER + _STL_FACET * facets:
        return MeshFormat.STL
    text = head.removeprefix(b"\xef\xbb\xbf").lstrip()
    binary = b"\0" in head
    if _PLY.match(head):
        return MeshFormat.PLY
    if head.startswith(b"glTF"):
        return MeshFormat.GLB
    if _named(head, _MAGIC[:1]) or (_DXF.search(head) and not binary):
        return MeshFormat.DXF
    _refuse_others(path, head, text)
    if path.suffix.casefold() == ".stl" and binary:
        return MeshFormat.STL
    found = None if binary else _in_text(text)
    if found is None:
        raise UnreadableError("mesh.unknown-format", file=path.name)
    return found


def cloud_format_of(path: Path) -> CloudFormat:
    """Format of a cloud of points.

    Parameters
    ----------
    path : Path
        A regular file.

    Raises
    ------
    UnreadableError
        If the file is empty, an archive, or nothing that foparq reads as a cloud; the error says which.
    """
    with path.open("rb") as stream:
        head = stream.read(_HEAD)
    if not head:
        raise UnreadableError("read.empty", file=path.name)
    if head.startswith(b"LASF"):
        return CloudFormat.LAS
    if _PLY.match(head):
        return CloudFormat.PLY
    text = head.removeprefix(b"\xef\xbb\xbf").lstrip()
    if archive := _named(head, _ARCHIVES):
        raise UnreadableError("read.archive", file=path.name, value=archive)
    other = _named(head, _MAGIC) or _named(text, _NO_MESHES) or ("glTF" if head.startswith(b"glTF") else "")
    if other or (b"\0" in head and not head.startswith((b"\xff\xfe", b"\xfe\xff"))):
        raise UnreadableError("cloud.not-a-cloud", file=path.name, value=str(other or "?"))
    return CloudFormat.TEXT


def holds_mesh(path: Path) -> bool:
    """Whether a loose file is one of the formats that hold nothing but meshes."""
    if not path.is_file():
        return False
    try:
        form = mesh_format_of(path)
        if form is MeshFormat.GLTF:  # in braces, as a GeoJSON is
            with path.open("rb") as stream:
                head = stream.read(_HEAD)
            return any(key in head for key in _GLTF) and b'"Feature' not in head
    except (InputError, OSError):
        return path.suffix.casefold() in _SUFFIXES  # told as what it is by who reads it
    return form is not MeshFormat.DXF


def _refuse_others(path: Path, head: bytes, text: bytes) -> None:
    if _DWG.match(head):
        raise UnreadableError("read.dwg", file=path.name, value=head[:6].decode("ascii", "replace"))
    if archive := _named(head, _ARCHIVES):
        raise UnreadableError("read.archive", file=path.name, value=archive)
    if other := _named(text, _NO_MESHES) or _named(head, _MAGIC[1:]):
        raise UnreadableError("mesh.not-a-mesh", file=path.name, value=str(other))


def _in_text(text: bytes) -> MeshFormat | None:
    if text.startswith(b"{"):
        return MeshFormat.GLTF
    if text[:5].lower() == b"solid":
        return MeshFormat.STL
    if _OFF.match(text):
        return MeshFormat.OFF
    return MeshFormat.OBJ if _OBJ.search(text) else None


def _named(head: bytes, table: tuple[tuple[bytes, str], ...]) -> str:
    return next((name for magic, name in table if head.startswith(magic)), "")
