# SPDX-License-Identifier: MIT
"""What a drawing's file says beside its linework, as columns: one row a statement."""

import json
from collections import Counter
from collections.abc import Callable
from dataclasses import asdict
from typing import Any

import numpy as np
import shapely

from foparq.check.drawn.unit_evidence import unit_evidence
from foparq.model.drawing import Drawing
from foparq.model.inputs import Bombs, HiddenItems, LayerNames, LayerPatterns, Named, Repairs, UnitEvidence
from foparq.model.items import holders_of
from foparq.model.layers import matches

NO_ROW = -1  #: the statement is about no item
#: statements that are there to be found: none of them means that the file was looked at
EXAMINED = frozenset({Repairs, Bombs, HiddenItems, LayerNames, LayerPatterns})


def all_layers(drawing: Drawing) -> set[str]:
    """Every layer of a drawing: also the empty ones, and those of inserts."""
    held = {holder.layer for text in set(drawing.items.holders.tolist()) for holder in holders_of(text)}
    return {*drawing.reading.layers, *drawing.items.layer.tolist(), *held}


def _about_file(layers: list[str], handles: list[str]) -> dict[str, Any]:
    """Naming columns of statements that are about no item."""
    n = len(layers)
    return {
        "layer": np.array(layers, dtype=object),
        "item": np.full(n, "", dtype=object),
        "handle": np.array(handles, dtype=object),
        "inserts": np.full(n, "", dtype=object),
        "row": np.full(n, NO_ROW, dtype=np.intp),
    }


def _repairs(drawing: Drawing) -> Repairs:
    repairs = drawing.reading.repairs
    names = _about_file([repair.layer for repair in repairs], [repair.handle for repair in repairs])
    return Repairs(
        code=np.array([repair.code for repair in repairs], dtype=object),
        says=np.array([json.dumps(asdict(repair)) for repair in repairs], dtype=object),
        **names,
    )


def _bombs(drawing: Drawing) -> Bombs:
    bombs = drawing.reading.bombs
    return Bombs(
        entities=np.array([bomb.entities for bomb in bombs], dtype=float),
        where=np.full(len(bombs), shapely.Point(), dtype=object),
        **_about_file([bomb.layer for bomb in bombs], [bomb.handle or bomb.block for bomb in bombs]),
    )


def _hidden_items(drawing: Drawing) -> HiddenItems:
    items = drawing.items
    hidden = np.flatnonzero(~items.visible & ~items.paper)
    layers, of = np.unique(items.layer[hidden].astype(str), return_inverse=True)
    box = shapely.bounds(items.geometry[hidden])
    low, high = np.full((len(layers), 2), np.inf), np.full((len(layers), 2), -np.inf)
    np.fmin.at(low, of, box[:, :2])
    np.fmax.at(high, of, box[:, 2:])
    where = np.full(len(layers), shapely.Point(), dtype=object)
    placed = np.isfinite(low).all(axis=1) & np.isfinite(high).all(axis=1)
    where[placed] = shapely.box(*low[placed].T, *high[placed].T)
    named = _about_file(layers.tolist(), [""] * len(layers))
    return HiddenItems(count=np.bincount(of, minlength=len(layers)).astype(float), where=where, **named)


def _layer_names(drawing: Drawing) -> LayerNames:
    bad = set(drawing.reading.bad_names)
    used = Counter(drawing.items.layer.tolist())
    names = sorted({*drawing.reading.layers, *used, *bad})
    return LayerNames(
        doubly_encoded=np.array([name in bad for name in names], dtype=bool),
        count=np.array([used[name] for name in names], dtype=float),
        **_about_file(names, [""] * len(names)),
    )


def _layer_patterns(drawing: Drawing) -> LayerPatterns:
    layers = all_layers(drawing)
    # What is left out and is not there leaves nothing out; what binds and is not there leaves a fault untold.
    patterns = sorted({*drawing.classes, *drawing.areas, *(pattern for group in drawing.bind for pattern in group)})
    matched = [any(matches(layer, (pattern,)) for layer in layers) for pattern in patterns]
    return LayerPatterns(matched=np.array(matched, dtype=bool), **_about_file(patterns, [""] * len(patterns)))


#: type of an input and what makes it
FACTS: dict[type, Callable[[Drawing], Named]] = {
    Repairs: _repairs,
    Bombs: _bombs,
    HiddenItems: _hidden_items,
    LayerNames: _layer_names,
    LayerPatterns: _layer_patterns,
    UnitEvidence: unit_evidence,
}
