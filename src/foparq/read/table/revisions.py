# SPDX-License-Identifier: MIT
"""What names of files say of revisions, copies and backups. Only a proposal: a person says which one holds."""

import re
from dataclasses import dataclass
from pathlib import PurePosixPath

from foparq.names import folded

#: ``fachada_rev2``, ``fachada-R02``, ``fachada v3``, ``fachada.revB``
_REVISION = re.compile(r"(?:[ _.\-]+(?:r|v)|[ _.\-]*(?:rev(?:is[aã]o)?|vers[aã]o|version))[ _.\-]*(\d+|[a-z])$")
#: ``fachada (1)``, ``fachada - cópia (2)``, ``fachada_old``: what a program or a careful person leaves behind
_COPY = re.compile(r"(?:[ _.\-]*\(\d+\)|[ _.\-]+(?:c[oó]pia|copy|copia|old|antig[oa]|bkp|bak|backup|anterior))$")
_LAST = re.compile(r"[ _.\-]+(?:final|definitiv[oa]|atual)$")
#: endings and beginnings of files that programs keep for themselves
_ASIDE = (".bak", ".sv$", ".ac$", ".dwl", ".dwl2", ".tmp", ".lck", ".lock", ".err")
_LOCK = ("~$", ".~lock.")
_FINAL = 1_000_000


@dataclass(frozen=True, slots=True)
class Revision:
    """What a name says."""

    base: str  #: folder and name without format and revision, folded
    rank: int  #: greater is later, as far as the name tells; below 0: a copy or an older one


def revision_of(path: str) -> Revision:
    """Revision that the name of a file states.

    Parameters
    ----------
    path : str
        With ``/``.

    Examples
    --------
    >>> revision_of("a/Fachada_rev2.dxf"), revision_of("a/fachada.gpkg")
    (Revision(base='a/fachada', rank=2), Revision(base='a/fachada', rank=0))
    >>> revision_of("fachada - Cópia.dxf").rank < 0 < revision_of("fachada_revB.dxf").rank
    True
    """
    pure = PurePosixPath(path)
    name, rank = folded(pure.stem), 0
    while True:
        if found := _REVISION.search(name):
            said = found[1]
            rank += int(said) if said.isdigit() else ord(said) - ord("a") + 1
        elif found := _LAST.search(name):
            rank += _FINAL
        elif found := _COPY.search(name):
            rank -= 2 * _FINAL
        if found is None or not found.start():
            return Revision((pure.parent / name).as_posix(), rank)
        name = name[: found.start()]


def is_aside(path: str) -> bool:
    """Whether a file is one that a program keeps for itself: a backup, or the lock of a file that is open.

    Examples
    --------
    >>> is_aside("a/~$pontos.xlsx"), is_aside("fachada.bak"), is_aside("fachada.dxf.bak"), is_aside("fachada.dxf")
    (True, True, True, False)
    """
    name = PurePosixPath(path).name.casefold()
    return name.endswith(_ASIDE) or name.startswith(_LOCK)
