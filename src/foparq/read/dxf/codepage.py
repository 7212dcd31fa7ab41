# SPDX-License-Identifier: MIT
"""The code page that a DXF file states, and how to have it used.

AutoCAD names code pages of Windows (``ANSI_1252``), DOS (``dos850``), Macintosh (``macintosh``) and of ISO
(``iso8859-1``); ezdxf knows those of Windows and takes every other for the Western one.
"""

import mmap
import re
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from ezdxf.tools.codepage import codepage_to_encoding

from foparq.read.letters import encoding_of

_TEXT = re.compile(rb"(?<![^\r\n \t])\$DWGCODEPAGE[ \t]*\r?\n[ \t]*3[ \t]*\r?\n([^\r\n]{0,100})")
_BINARY = re.compile(rb"\$DWGCODEPAGE\x00\x03\x00?([^\x00]{0,100})\x00")  #: the group code has one byte in R12


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
