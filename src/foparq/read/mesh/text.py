# SPDX-License-Identifier: MIT
"""Text of millions of lines, read as columns: pieces of whole lines, their words, and the numbers in them.

A piece is some megabytes of the file, so that the columns of bytes and words that it takes stay small.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from foparq.columns import Flags, Index
from foparq.errors import UnreadableError, UnsafeError

Bytes = NDArray[np.uint8]

PIECE = 1 << 23  #: bytes
LONGEST_LINE = 1 << 26  #: bytes
BLANK = 32
_NEWLINE = 10
#: they would separate words here and nowhere else
_CONTROLS = bytes(set(range(BLANK)) - set(b"\t\n\v\f\r"))
_END = b"\x1a\t\n\v\f\r "
_SHOWN = 40  #: letters of an odd word that a message repeats


@dataclass(frozen=True, slots=True)
class Piece:
    """Some whole lines of a file."""

    file: str  #: for messages
    data: bytes  #: the whole file
    at: int  #: of the first byte, in the file
    text: Bytes  #: (b,) ends with a line feed; may be written to, byte for byte
    start: Index  #: (k,) first byte of each line that is not blank, in the piece
    end: Index  #: (k,) behind its line feed
    blank: bool  #: whether there are blank lines beside

    def line_of(self, byte: int) -> int:
        """Number of the line, from 1, in which a byte of the piece stands."""
        before = self.data[: self.at + byte]
        return 1 + (before.count(b"\n") or before.count(b"\r"))

    def words_of(self, row: int, most: int = LONGEST_LINE) -> list[str]:
        """Words of a line as the file holds it, of at most so many bytes."""
        # Split as bytes: letters beyond ASCII that count as blanks are none here.
        return [decoded(word) for word in self._said(row, most)]

    def name_of(self, row: int) -> str:
        """What stands behind the first word of a line, with one blank between words."""
        return decoded(b" ".join(self._said(row, LONGEST_LINE)[1:]))

    def _said(self, row: int, most: int) -> list[bytes]:
        begin, end = self.at + int(self.start[row]), self.at + int(self.end[row])
        said = self.data[begin : min(end, begin + most)]
        if b"\\" in said:
            said = said.replace(b"\\\n", b" ").replace(b"\\\r\n", b" ")
        return said.split()

    def wrong(self, row: int, example: str) -> UnreadableError:
        """Error that says of a line what would be right there."""
        value = " ".join(self.words_of(row, 4 * _SHOWN))
        shown = value if len(value) <= _SHOWN else f"{value[:_SHOWN]}..."
        line = self.line_of(int(self.start[row]))
        return UnreadableError("mesh.line", file=self.file, line=line, value=shown, example=example)


def decoded(text: bytes) -> str:
    """Text of a file that states no encoding: UTF-8, else that of Windows."""
    try:
        return text.decode("utf-8")
    except UnicodeDecodeError:
        return text.decode("cp1252", "replace")


def pieces(data: bytes, begin: int, *, file: str, joined: bool = False) -> Iterator[Piece]:
    """The text from a byte on, in pieces of whole lines.

    Parameters
    ----------
    data : bytes
        The whole file. Lines end with a line feed, also after a carriage return; if there is none, with carriage
        returns.
    begin : int
        First byte.
    file : str
        For messages.
    joined : bool
        Whether a backslash at the end of a line joins the next to it.

    Raises
    ------
    UnreadableError
        If the text holds control characters other than blanks; one that ends it, as DOS wrote it, is none.
    UnsafeError
        If a line has more than :data:`LONGEST_LINE` bytes.
    """
    feed = b"\n" if data.find(b"\n", begin) >= 0 or data.find(b"\r", begin) < 0 else b"\r"
    at = begin
    while at < len(data):
        end = _cut(data, at, feed, joined=joined)
        if end - at > LONGEST_LINE:
            raise UnsafeError("mesh.long-line", file=file, limit=LONGEST_LINE)
        raw = data[at:end] if end < len(data) else data[at:end].rstrip(_END)
        if len(raw.translate(None, _CONTROLS)) < len(raw):
            odd = next(byte for byte, letter in enumerate(raw) if letter in _CONTROLS)
            raise UnreadableError("mesh.control", file=file, byte=at + odd, value=f"0x{raw[odd]:02x}")
        if feed == b"\r":
            raw = raw.replace(b"\r", b"\n")
        if joined and b"\\" in raw:
            # As many bytes as before: what stands where is not moved.
            raw = raw.replace(b"\\\n", b"  ").replace(b"\\\r\n", b"   ")
        raw = raw if raw.endswith(b"\n") else raw + b"\n"
        yield _piece(file, data, at, np.frombuffer(raw, dtype=np.uint8).copy())
        at = end


def _cut(data: bytes, at: int, feed: bytes, *, joined: bool) -> int:
    """Byte behind the last whole line of a piece that begins at a byte."""
    most = at + PIECE
    if most >= len(data):
        return len(data)
    end = data.rfind(feed, at, most) + 1 or data.find(feed, most) + 1 or len(data)
    while joined and end < len(data) and data[max(end - 3, at) : end - 1].rstrip(b"\r").endswith(b"\\"):
        end = data.find(feed, end) + 1 or len(data)
        if end - at > LONGEST_LINE:
            break
    return end


def _piece(file: str, data: bytes, at: int, text: Bytes) -> Piece:
    end = np.flatnonzero(text == _NEWLINE) + 1
    start = np.concatenate([np.zeros(1, dtype=np.intp), end[:-1]])
    indented = np.flatnonzero(text[start] <= BLANK)
    if len(indented):
        black = np.append(np.flatnonzero(text > BLANK), len(text))
        start[indented] = black[np.searchsorted(black, start[indented])]
    filled = start < end
    return Piece(file, data, at, text, start[filled], end[filled], blank=not filled.all())


def lines_of(piece: Piece, chosen: Flags) -> Bytes:
    """Text of some lines of a piece, one behind the other.

    Parameters
    ----------
    chosen : (k,) bool
        By line.
    """
    if chosen.all() and not piece.blank:
        return piece.text
    edge = np.zeros(len(piece.text) + 1, dtype=np.int8)
    # A line may begin where the one before ends: both marks add up.
    edge[piece.start[chosen]] += 1
    edge[piece.end[chosen]] -= 1
    inside: Flags = np.add.accumulate(edge[:-1], dtype=np.int8).astype(bool)
    return piece.text[inside]


def uncommented(text: Bytes, mark: str = "#") -> Bytes:
    """Text with blanks from a mark to the end of each line; the same array if no mark begins a word."""
    marks = np.flatnonzero(text == ord(mark))
    marks = marks[(marks == 0) | (text[marks - 1] <= BLANK)]
    if not len(marks):
        return text
    end = np.flatnonzero(text == _NEWLINE)
    line = np.searchsorted(end, marks)
    first = np.concatenate([[True], line[1:] != line[:-1]])
    edge = np.zeros(len(text) + 1, dtype=np.int8)
    edge[marks[first]] += 1
    edge[end[line[first]]] -= 1
    return np.where(np.add.accumulate(edge[:-1], dtype=np.int8).astype(bool), np.uint8(BLANK), text)


def word_starts(text: Bytes) -> Flags:
    """(b,) true where a word begins."""
    black = text > BLANK
    starts = black.copy()
    starts[1:] &= ~black[:-1]
    return starts


def counts_by_line(text: Bytes, flags: Flags) -> Index:
    """(k,) number of marked bytes in every line of a text.

    Parameters
    ----------
    text : (b,) uint8
        Ends with a line feed.
    flags : (b,) bool
    """
    end = np.flatnonzero(text == _NEWLINE)
    if not len(end):
        return np.zeros(0, dtype=np.intp)
    start = np.concatenate([np.zeros(1, dtype=np.intp), end[:-1] + 1])
    return np.add.reduceat(flags, start, dtype=np.intp)


def keywords(piece: Piece, words: dict[str, int]) -> Index:
    """(k,) which of some words begins each line; 0 for none of them.

    Parameters
    ----------
    words : dict
        Word of at most eight small letters to its number. Capital letters count as small ones.
    """
    letters = np.zeros((len(piece.start), 8), dtype=np.uint8)
    inside = np.ones(len(piece.start), dtype=bool)
    last = len(piece.text) - 1
    for column in range(9):
        letter = piece.text[np.minimum(piece.start + column, last)]
        inside &= letter > BLANK
        if column < letters.shape[1]:
            capital = (letter >= ord("A")) & (letter <= ord("Z"))
            letters[:, column] = np.where(inside, letter + np.uint8(32) * capital, 0)
    key = letters.view(np.uint64)[:, 0]
    kinds = np.zeros(len(key), dtype=np.intp)
    for word, number in words.items():
        kinds[(key == np.frombuffer(word.encode().ljust(8, b"\0"), dtype=np.uint64)) & ~inside] = number
    return kinds


def blank_out(piece: Piece, chosen: Flags, letters: int) -> None:
    """Write blanks over the first letters of some lines."""
    start = piece.start[chosen]
    for column in range(letters):
        piece.text[start + column] = BLANK
