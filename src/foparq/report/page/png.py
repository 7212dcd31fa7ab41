# SPDX-License-Identifier: MIT
"""Pictures of few tones as PNG (ISO/IEC 15948), written by hand: no image library is needed for them."""

import struct
import zlib

import numpy as np
from numpy.typing import NDArray

_GREY, _PALETTE = 0, 3  #: kinds of colour


def grey_png(pixels: NDArray[np.uint8]) -> bytes:
    """PNG of 8-bit greys.

    Parameters
    ----------
    pixels : (height, width) uint8
        0 black, 255 white.

    Returns
    -------
    bytes
        The file.
    """
    return _png(pixels, _GREY)


def palette_png(pixels: NDArray[np.uint8], palette: NDArray[np.uint8]) -> bytes:
    """PNG of the colours of a palette.

    Parameters
    ----------
    pixels : (height, width) uint8
        Rows of the palette.
    palette : (n, 3) uint8
        Red, green and blue; at most 256 rows.

    Returns
    -------
    bytes
        The file.
    """
    return _png(pixels, _PALETTE, (b"PLTE", palette.astype(np.uint8).tobytes()))


def _png(pixels: NDArray[np.uint8], kind: int, *more: tuple[bytes, bytes]) -> bytes:
    height, width = pixels.shape
    lines = np.zeros((height, width + 1), dtype=np.uint8)  # first byte of a line: filter type none
    lines[:, 1:] = pixels
    header = struct.pack(">IIBBBBB", width, height, 8, kind, 0, 0, 0)
    chunks = ((b"IHDR", header), *more, (b"IDAT", zlib.compress(lines.tobytes(), 6)), (b"IEND", b""))
    return b"\x89PNG\r\n\x1a\n" + b"".join(_chunk(name, data) for name, data in chunks)


def _chunk(name: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
