# SPDX-License-Identifier: MIT
"""Encoding of the texts of a Shapefile: as its ``.cpg`` states, or as the bytes of its ``.dbf`` prove."""

import codecs
from dataclasses import dataclass
from pathlib import Path

from foparq.read.letters import encoding_of

_UTF8 = "utf-8"
_LANGUAGE = 29  #: byte of the header that names a code page; 0 if none
_BLOCK = 1 << 20  #: bytes looked at in one piece
_LONGEST = 40  #: letters of the name of an encoding
_BY_NUMBER = "ldid/"  #: a ``.cpg`` that names the code page by the number of the ``.dbf``, which GDAL knows


@dataclass(frozen=True, slots=True)
class Encoding:
    """How the texts of a Shapefile are read."""

    stated: str  #: by the ``.cpg``, ``""`` if it is missing
    name: str  #: Python's name of it, ``""`` to leave it to GDAL, which looks at the header and else takes Latin-1
    unknown: bool = False  #: whether a code page is stated that nobody knows


def encoding_of_dbf(dbf: Path, cpg: Path | None) -> Encoding:
    """Encoding of the texts of a Shapefile.

    Parameters
    ----------
    dbf : Path
        Table of attributes.
    cpg : Path or None
        File of one line that states the encoding.

    Returns
    -------
    Encoding
        What is stated. Where nobody states anything, UTF-8 if the bytes prove it: they hold letters beyond ASCII, and
        all are valid UTF-8, which texts of another encoding are not.

    Notes
    -----
    O(bytes) time; memory does not grow with the file.
    """
    stated = ""
    if cpg is not None:
        with cpg.open("rb") as stream:
            stated = stream.read(_LONGEST).decode("ascii", "replace").strip()
    name = encoding_of(stated)
    if not name and not (stated.lower().startswith(_BY_NUMBER) or _language(dbf)) and _utf8(dbf):
        name = _UTF8
    unknown = bool(stated) and not name and not stated.lower().startswith(_BY_NUMBER)
    return Encoding(stated, name, unknown=unknown)


def _language(dbf: Path) -> int:
    with dbf.open("rb") as stream:
        head = stream.read(_LANGUAGE + 1)
    return head[_LANGUAGE] if len(head) > _LANGUAGE else 0


def _utf8(dbf: Path) -> bool:
    """Whether the rows of a table hold letters beyond ASCII, and all are valid UTF-8."""
    decoder = codecs.getincrementaldecoder(_UTF8)()
    found = False
    with dbf.open("rb") as stream:
        head = stream.read(10)
        stream.seek(int.from_bytes(head[8:10], "little"))
        try:
            while block := stream.read(_BLOCK):
                found = found or not block.isascii()
                decoder.decode(block)
            decoder.decode(b"", final=True)
        except UnicodeDecodeError:
            return False
    return found
