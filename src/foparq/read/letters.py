# SPDX-License-Identifier: MIT
"""Letters of names: the encodings that files state, and names whose letters are not those that were meant."""

import codecs
import re

_ISO = re.compile(r"(?:iso)?[-_ ]*8859[-_ ]*([0-9]{1,2})")
_NUMBERED = re.compile(r"(?:ansi|dos|cp|windows|ibm|oem|ms|msdos|pc)?[-_ ]*([0-9]{3,5})")
_NAMED = {
    "ascii": "ascii", "usascii": "ascii", "utf8": "utf-8", "65001": "utf-8",
    "mac": "mac_roman", "macroman": "mac_roman", "macintosh": "mac_roman",
    "big5": "cp950", "gb2312": "gbk", "936": "gbk", "ksc5601": "cp949", "johab": "johab", "1361": "johab",
}  # fmt: skip
#: reads the same in every code page of a drawing; of signs, some have another meaning in a few of them
_PLAIN = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789 $*+-._"
_LOST = "\ufffd"  #: stands for bytes that mean nothing in the encoding


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


def garbled(name: str, encoding: str) -> bool:
    """Tell whether a name was encoded twice, or holds bytes that its encoding does not know.

    Parameters
    ----------
    encoding : str
        Encoding in which the file was read, by Python's name.
    """
    return _LOST in name or doubly_encoded(name, encoding)


def doubly_encoded(name: str, encoding: str) -> bool:
    """Tell whether a name looks like UTF-8 that was read in another encoding: ``"VÃ£os"``.

    Parameters
    ----------
    encoding : str
        Encoding of the file.

    Notes
    -----
    True if the bytes of the name in that encoding, or in cp1252, are valid UTF-8 beyond ASCII. A name in another
    language passes by chance only if every accented letter is followed by a fitting sign.
    """
    if name.isascii():
        return False
    for candidate in (encoding, "cp1252"):
        data = _bytes(name, candidate)
        try:
            if data is not None and not data.isascii() and data.decode("utf-8") != name:
                return True
        except UnicodeDecodeError:
            continue
    return False


def _bytes(name: str, encoding: str) -> bytes | None:
    if encoding.replace("-", "").lower() == "utf8":
        return None
    data = bytearray()
    for letter in name:
        try:
            data += letter.encode(encoding)
        except (UnicodeEncodeError, LookupError):
            if not 0x80 <= ord(letter) <= 0x9F:  # noqa: PLR2004 - undefined bytes of cp1252 come through as they are
                return None
            data.append(ord(letter))
    return bytes(data)
