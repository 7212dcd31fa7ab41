# SPDX-License-Identifier: MIT
"""Layers by pattern: ``*``, ``?`` and ``[...]``; case and composition of accents do not matter."""

from collections.abc import Iterable, Mapping, Sequence
from fnmatch import fnmatchcase

import numpy as np

from foparq.columns import Flags, Index, Texts
from foparq.names import folded, of_kind

#: layer of the points of dimensions, which CAD never plots, whatever a file states of it
NEVER_PLOTTED = "Defpoints"

_MAGIC = frozenset("*?[")


def matches(layer: str, patterns: Sequence[str]) -> bool:
    """Whether a layer name matches one of the patterns."""
    name = folded(layer)
    return any(fnmatchcase(name, folded(pattern)) for pattern in patterns)


def matching(layers: Texts, patterns: Sequence[str]) -> Flags:
    """(n,) whether each layer name matches one of the patterns; each name is asked once."""
    if "*" in patterns:
        return np.ones(len(layers), dtype=bool)
    names, inverse = np.unique(layers.astype(str), return_inverse=True)
    hit = np.array([matches(name, patterns) for name in names], dtype=bool)
    return hit[inverse] if len(names) else np.zeros(0, dtype=bool)


def literal(layer: str) -> str:
    """Pattern that only this layer matches."""
    return "".join(f"[{c}]" if c in _MAGIC else c for c in layer)


def class_of(layer: str, classes: Mapping[str, str]) -> str:
    """Feature class of a layer: that of the first pattern that it matches; ``""`` if it matches none."""
    return next((name for pattern, name in classes.items() if matches(layer, (pattern,))), "")


def bonds(layers: Texts, classes: Mapping[str, str], bind: Sequence[Sequence[str]]) -> Index:
    """Which layers are drawn as one.

    Layers bind if their names are one, if they belong to one feature class, or if patterns of one group of ``bind``
    match them. What binds with the same binds with each other.

    Parameters
    ----------
    layers : (n,) str
    classes : mapping of layer pattern to feature class
        The first pattern that matches gives the class; names of classes are compared as :func:`foparq.names.of_kind`
        does.
    bind : sequence of groups of layer patterns

    Returns
    -------
    (n,) int
        Equal numbers for layers that bind.

    Examples
    --------
    >>> bonds(np.array(["WALL", "Wall", "DOOR", "SILL"], dtype=object), {}, [["door", "s*"]]).tolist()
    [1, 1, 0, 0]
    """
    names, inverse = np.unique(layers.astype(str), return_inverse=True)
    joined = _Joined()
    for name in names.tolist():
        kind = of_kind(class_of(name, classes))
        said = [("class", kind)] if kind else []
        said += [("bind", str(n)) for n, patterns in enumerate(bind) if matches(name, patterns)]
        joined.join(("layer", folded(name)), said)
    number = joined.numbers(("layer", folded(name)) for name in names.tolist())
    return number[inverse] if len(names) else number


_Key = tuple[str, str]


class _Joined:
    """Things that are one because they share something: a forest of which each tree is one."""

    def __init__(self) -> None:
        self._above: dict[_Key, _Key] = {}

    def join(self, one: _Key, others: Sequence[_Key]) -> None:
        for other in others:
            self._above[self._root(other)] = self._root(one)

    def numbers(self, keys: Iterable[_Key]) -> Index:
        known: dict[_Key, int] = {}
        return np.array([known.setdefault(self._root(key), len(known)) for key in keys], dtype=np.intp)

    def _root(self, key: _Key) -> _Key:
        while (above := self._above.get(key, key)) != key:
            self._above[key] = self._above.get(above, above)
            key = above
        return key
