# SPDX-License-Identifier: MIT
"""The files that make up a Shapefile."""

from pathlib import Path

from foparq.errors import UnreadableError, UnsafeError
from foparq.names import folded
from foparq.read.guard.paths import fit_to_read

#: endings of the files that belong to a Shapefile, beside ``.shp``
ENDINGS = frozenset({".shx", ".dbf", ".prj", ".cpg", ".qix", ".qpj", ".sbn", ".sbx", ".qmd"})
_SHORT = frozenset({".prj", ".cpg", ".qpj"})  #: a line of text
_SHORT_BYTES = 100_000


def companions(path: Path, limit: int) -> dict[str, Path]:
    """Files that belong to a Shapefile, by ending in small letters: ``{".dbf": ...}``.

    Their names may differ from its own in the case of letters and the composition of accents.

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
    alike = [other for other in sorted(path.parent.iterdir()) if folded(other.stem) == folded(path.stem)]
    if sum(other.suffix.casefold() == path.suffix.casefold() for other in alike) > 1:
        # Two Shapefiles whose names differ in case: each has its own.
        alike = [other for other in alike if other.stem == path.stem]
    for other in alike:
        ending = other.suffix.casefold()
        if ending in ENDINGS and not (ending in found and other.stem != path.stem):
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
