# SPDX-License-Identifier: MIT
"""The code page that a DXF file states, and how to have it used.

AutoCAD names code pages of Windows (``ANSI_1252``), DOS (``dos850``), Macintosh (``macintosh``) and of ISO
(``iso8859-1``); ezdxf knows those of Windows and takes every other for the Western one.
"""

import codecs
import mmap
import re
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from ezdxf.tools.codepage import codepage_to_encoding

_TEXT = re.compile(rb"(?<![^\r\n \t])\$DWGCODEPAGE[ \t]*\r?\n[ \t]*3[ \t]*\r?\n([^\r\n]{0,100})")
_BINARY = re.compile(rb"\$DWGCODEPAGE\x00\x03\x00?([^\x00]{0,100})\x00")  #: the group code has one byte in R12
_ISO = re.compile(r"(?:iso)?[-_ ]*8859[-_ ]*([0-9]{1,2})")
_NUMBERED = re.compile(r"(?:ansi|dos|cp|windows|ibm|oem|ms|msdos|pc)?[-_ ]*([0-9]{3,5})")
_NAMED = {
    "ascii": "ascii", "usascii": "ascii", "utf8": "utf-8", "65001": "utf-8",
    "mac": "mac_roman", "macroman": "mac_roman", "macintosh": "mac_roman",
    "big5": "cp950", "gb2312": "gbk", "936": "gbk", "ksc5601": "cp949", "johab": "johab", "1361": "johab",
}  # fmt: skip
#: reads the same in every code page of a DXF file; of signs, some have another meaning in a few of them
_PLAIN = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789 $*+-._"


@dataclass(frozen=True, slots=True)
class CodePage:
    """What a file says of its code page."""

    stated: str  #: as written, without blanks around it; ``""`` if the file says nothing
    encoding: str  #: Python's name of it; ``""`` if nothing is said or nobody knows what is

    @property
    def unknown(self) -> bool:
        """Whether the file names a code page that nobody knows."""
        return bool(self.stated) and not self.encoding


def code_page_of(path: Path, *, binary: bool) -> CodePage:
    """Code page that the header of a DXF file states.

    Parameters
    ----------
    binary : bool
        True for a binary DXF.

    Returns
    -------
    CodePage
        As stated; from R2007 on a file is in UTF-8, whatever it states.
    """
    with path.open("rb") as stream, mmap.mmap(stream.fileno(), 0, access=mmap.ACCESS_READ) as content:
        found = (_BINARY if binary else _TEXT).search(content)
        stated = found[1].decode("ascii", "replace").strip() if found else ""
    return CodePage(stated, encoding_of(stated))


def encoding_of(stated: str) -> str:
    """Python's name of a code page; ``""`` if it is unknown.

    Examples
    --------
    >>> encoding_of("dos850"), encoding_of("ISO8859-15"), encoding_of("macintosh"), encoding_of("dos999")
    ('cp850', 'iso8859-15', 'mac-roman', '')
    """
    name = stated.strip().lower()
    candidates = [_NAMED.get(re.sub(r"[-_ ]", "", name), "")]
    if found := _ISO.fullmatch(name):
        candidates = [f"iso8859_{found[1]}"]
    elif found := _NUMBERED.fullmatch(name):
        candidates = [_NAMED.get(found[1], f"cp{found[1]}")]
    return next((codec for one in candidates if one and (codec := _codec(one))), "")


def _codec(name: str) -> str:
    # Of what Python knows, only code pages that hold the letters of the file's own syntax: not those of mainframes.
    try:
        known = codecs.lookup(name)
        plain = known.decode(_PLAIN.encode("ascii"))[0]
    except (LookupError, UnicodeError):
        return ""
    return known.name if plain == _PLAIN else ""


@contextmanager
def taught(page: CodePage) -> Iterator[None]:
    """Have ezdxf use the code page of a file while it is read."""
    known = dict(codepage_to_encoding)
    if page.encoding:
        # ezdxf takes the first name with which the stated one ends; of a binary file it may lose the first letter.
        codepage_to_encoding.clear()
        codepage_to_encoding.update({page.stated: page.encoding, page.stated[1:]: page.encoding}, **known)
    try:
        yield
    finally:
        codepage_to_encoding.clear()
        codepage_to_encoding.update(known)
