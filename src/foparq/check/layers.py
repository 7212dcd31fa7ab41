# SPDX-License-Identifier: MIT
"""Layers by pattern: ``*``, ``?`` and ``[...]``; case and composition of accents do not matter."""

from collections.abc import Sequence
from fnmatch import fnmatchcase

import numpy as np

from foparq.columns import Flags, Texts
from foparq.names import folded

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
