# SPDX-License-Identifier: MIT
"""The files that make up a Shapefile."""

from pathlib import Path

from foparq.errors import UnreadableError, UnsafeError
from foparq.read.guard.paths import fit_to_read

#: endings of the files that belong to a Shapefile, beside ``.shp``
ENDINGS = frozenset({".shx", ".dbf", ".prj", ".cpg", ".qix", ".qpj", ".sbn", ".sbx", ".qmd"})
_SHORT = frozenset({".prj", ".cpg", ".qpj"})  #: a line of text
_SHORT_BYTES = 100_000


def companions(path: Path, limit: int) -> dict[str, Path]:
    """Files that belong to a Shapefile, by ending in small letters: ``{".dbf": ...}``.

    Parameters
    ----------
    path : Path
        The ``.shp``.
    limit : int
        Bytes that one of them may hold.

    Raises
    ------
    UnreadableError
        If one of them is no regular file.
    UnsafeError
        If one of them is a link that leads elsewhere, or too large.
    """
    found: dict[str, Path] = {}
    for other in sorted(path.parent.iterdir()):
        ending = other.suffix.casefold()
        if other.stem == path.stem and ending in ENDINGS:
            _hold(path, other, min(limit, _SHORT_BYTES) if ending in _SHORT else limit)
            found[ending] = other
    return found


def _hold(path: Path, other: Path, limit: int) -> None:
    fields = {"file": path.name, "key": other.name}
    try:
        full = other.resolve(strict=True)
    except (OSError, RuntimeError):
        raise UnreadableError("read.companion-odd", **fields) from None
    if full.parent != path.resolve().parent:
        raise UnsafeError("read.companion-outside", **fields)
    try:
        fit_to_read(full, limit)
    except UnsafeError:
        raise UnsafeError("read.companion-large", **fields, value=full.stat().st_size, limit=limit) from None
    except UnreadableError:
        raise UnreadableError("read.companion-odd", **fields) from None
