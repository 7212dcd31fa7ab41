# SPDX-License-Identifier: MIT
"""What a file is, told from its first bytes and never from its name."""

import re
from enum import StrEnum
from pathlib import Path

from foparq.errors import UnreadableError

_HEAD = 8192


class Format(StrEnum):
    """Formats of drawings that foparq reads."""

    DXF = "dxf"
    GPKG = "gpkg"
    SHAPEFILE = "shapefile"
    GEOJSON = "geojson"


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


def _named(head: bytes, table: tuple[tuple[bytes, str], ...]) -> str:
    return next((name for magic, name in table if head.startswith(magic)), "")
