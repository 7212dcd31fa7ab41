# SPDX-License-Identifier: MIT
"""Names whose letters are not those that were meant."""

_LOST = "\ufffd"  #: stands for bytes that mean nothing in the encoding


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
