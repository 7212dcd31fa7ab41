# SPDX-License-Identifier: MIT
"""Which class of a list a layer is named like, and which facade a file: proposals that a person reads."""

import re
from collections.abc import Sequence
from pathlib import PurePosixPath

from foparq.names import folded, of_kind, unaccented

_WORD = re.compile(r"[^\W\d_]+")
_SHORTEST = 3  #: letters of an abbreviation: ``JAN`` for ``janela``
#: words for one kind of thing in Portuguese, English and Spanish
_SAME = (
    ("janela", "window", "ventana", "esquadria"), ("porta", "door", "puerta"), ("coluna", "column", "columna"),
    ("cornija", "cornice", "cimalha", "cornisa"), ("pilastra", "pilaster"), ("ornamento", "ornament", "ornato"),
    ("almofada", "painel", "panel"), ("sacada", "balcao", "balcony", "balcon"), ("gradil", "grade", "railing", "reja"),
    ("cobertura", "telhado", "roof", "cubierta"), ("escada", "stair", "escalera"), ("toldo", "marquise", "awning"),
    ("relogio", "clock", "reloj"), ("parede", "alvenaria", "wall", "muro", "pared"), ("arco", "arch"),
    ("cantaria", "silharia", "ashlar", "silleria"), ("moldura", "moulding", "molding"), ("vao", "opening", "vano"),
    ("frontao", "pediment", "fronton"), ("balaustre", "baluster"), ("beiral", "eaves", "alero"),
)  # fmt: skip

#: words for what helps to draw or to read and shows nothing of the building
_AIDS = (
    "eixo", "axis", "eje", "cota", "dimension", "dim", "malha", "grid", "auxiliar", "aux", "rascunho", "construcao",
    "carimbo", "selo", "margem", "viewport", "vport",
)  # fmt: skip


def aids_like(layers: Sequence[str]) -> tuple[str, ...]:
    """Layers that are named like axes, dimensions, grids and other aids.

    Examples
    --------
    >>> aids_like(["EIXOS", "A-COTAS", "PAREDE", "COTAÇÃO", "Malha"])
    ('EIXOS', 'A-COTAS', 'Malha')
    """
    kinds = {of_kind(word) for word in _AIDS}
    return tuple(layer for layer in layers if any(of_kind(word) in kinds for word in _WORD.findall(unaccented(layer))))


def class_like(layer: str, classes: Sequence[str]) -> str | None:
    """Class of the list that a layer is named like: the same word, its beginning, or one that means the same.

    Examples
    --------
    >>> [class_like(layer, ["door", "janela"]) for layer in ("A-ESQ-JANELAS", "PORTAS", "COTAS")]
    ['janela', 'door', None]
    """
    words = [of_kind(word) for word in _WORD.findall(unaccented(layer))]
    for name in classes:
        kind = of_kind(name)
        if kind in words or kind in of_kind(layer):
            return name
    for name in classes:
        meant = next(({of_kind(word) for word in same} for same in _SAME if of_kind(name) in map(of_kind, same)), set())
        meant.add(of_kind(name))
        if any(word in meant or (len(word) >= _SHORTEST and _begins(word, meant)) for word in words):
            return name
    return None


def _begins(word: str, meant: set[str]) -> bool:
    return any(name.startswith(word) for name in meant)


def facade_like(path: str, facades: Sequence[str]) -> str | None:
    """Facade of the list that the name of a file holds as a word.

    Examples
    --------
    >>> facade_like("fachada_Norte.dxf", ["Norte", "Sul"]), facade_like("fachada-n.dxf", ["N", "S"])
    ('Norte', 'N')
    """
    words = set(re.split(r"[\W_]+", unaccented(PurePosixPath(path).stem)))
    return next((facade for facade in facades if unaccented(facade) in words or folded(facade) in words), None)
