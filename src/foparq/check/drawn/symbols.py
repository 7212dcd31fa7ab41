# SPDX-License-Identifier: MIT
"""Which block inserts of a drawing are point symbols: crosses, targets, heights, and no linework of the building."""

import re
import traceback
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from foparq.check.bounds import Bounded, Broken, budget_of, unbounded
from foparq.check.drawn.columns import Columns
from foparq.columns import Flags, Index, Texts, union
from foparq.findings.because import Because
from foparq.geom.chains import NOBODY
from foparq.geom.polylines import summed
from foparq.geom.standing import alone, fitting, joined
from foparq.model.delivery import Delivery
from foparq.model.drawing import Drawing, Skipped, SkippedReason
from foparq.model.inputs import Lines
from foparq.model.items import Holder, Items, holders_of
from foparq.model.layers import matches
from foparq.model.symbols import SymbolBlock, Symbols
from foparq.names import folded, of_kind
from foparq.profile.schema import Profile

_HANDLES = 5  #: of a block that are named
_ONE_PLACE = 20  #: places nearer than this part of what is visible are one
_ALIKE = 1e-6  #: share of their length by which nameless inserts of one block may differ
_PART = re.compile(r"(.+)\.\d+")  #: id of a part of a feature, and that of the feature
_ANONYMOUS = "*"  #: begins the name of a block that a program made: each form of a dynamic block has its own


class Measures(NamedTuple):
    """What makes a symbol, metres and radians."""

    size: float  #: diameter of the circle into which it fits
    times: int  #: inserts from which on a block is a sign that is repeated
    visible: float  #: an end not farther from a line seems to rest on it
    clear: float  #: nothing else is as near to a symbol that stands alone
    alongside: float  #: what turns less runs alongside


def with_symbols(
    delivery: Delivery, profile: Profile, scale: float | None, bounded: Bounded = unbounded
) -> tuple[Delivery, tuple[str, ...]]:
    """Delivery whose drawings know their point symbols, and list them among what was not checked.

    Parameters
    ----------
    scale : float or None
        Denominator of the drawing scale. Without one nobody knows what is small on the sheet: there are no symbols.
    bounded : Bounded
        Keeps the search within the bounds of the profile.

    Returns
    -------
    delivery : Delivery
    log : tuple of str
        Tracebacks of what crashed. A drawing of which the search broke off says so.
    """
    measures = _measures(profile, scale)
    if measures is None:
        return delivery, ()
    listed = delivery.features.feature_class.tolist() if delivery.features else []
    found: dict[str, Symbols] = {}
    log: list[str] = []
    for drawing in delivery.drawings:
        if drawing.unit.metres is None or not any(_grouped(drawing.items)):
            continue
        hidden = profile.reading.hidden == "check"
        args = (drawing, measures, frozenset(map(of_kind, listed)), hidden)
        for thing in bounded(_searched, args, budget_of(drawing, profile.limits, 0.0)):
            if isinstance(thing, Broken):
                found[drawing.path] = Symbols(broken=thing.because.value)
                log += [f"symbols of {drawing.path}\n{thing.trace}"] if thing.trace else []
            elif isinstance(thing, Symbols):
                found[drawing.path] = thing
    return _knowing(delivery, found), tuple(log)


def _measures(profile: Profile, scale: float | None) -> Measures | None:
    spec = profile.linework
    if scale is None and (spec.symbol.at_scale or spec.heading.at_scale):
        return None
    visible = profile.least_seen(scale)
    size = spec.symbol.si(scale)
    clear = max(spec.heading.si(scale), visible)
    return Measures(size, spec.symbol_times, visible, clear, spec.alongside.si()) if size > 0 else None


def _searched(drawing: Drawing, measures: Measures, kinds: frozenset[str], hidden: bool) -> Iterator[object]:  # noqa: FBT001 - crosses a process border
    try:
        yield symbols_of(drawing, measures, kinds, hidden=hidden)
    except MemoryError:
        yield Broken(Because.LIMIT)
    except Exception:  # noqa: BLE001 - a crash is ours: the rules on linework do not run
        yield Broken(Because.CRASHED, traceback.format_exc())


def _knowing(delivery: Delivery, found: dict[str, Symbols]) -> Delivery:
    skipped = {path: _skipped(symbols) for path, symbols in found.items()}
    parts = tuple(
        replace(
            part, symbols=found[part.path],
            reading=replace(part.reading, skipped=(*part.reading.skipped, *skipped[part.path])),
        )
        if isinstance(part, Drawing) and part.path in found else part
        for part in delivery.parts
    )  # fmt: skip
    sources = tuple(
        replace(source, skipped=(*source.skipped, *skipped[source.path]))
        if source.role == "drawing" and source.path in found else source
        for source in delivery.sources
    )  # fmt: skip
    return replace(delivery, parts=parts, sources=sources)


def _skipped(symbols: Symbols) -> tuple[Skipped, ...]:
    return tuple(
        Skipped(
            reason=SkippedReason.POINT_SYMBOL, kind="INSERT", layer=layer, count=n, handles=block.handles,
            name=block.name,
        )
        for block in symbols.blocks
        for layer, n in block.layers
    )  # fmt: skip


def symbols_of(drawing: Drawing, measures: Measures, kinds: frozenset[str] = frozenset(), *, hidden: bool) -> Symbols:
    """Point symbols of one drawing.

    An insert *may* be a symbol if its linework fits into a circle of diameter ``size``; of inserts within each other
    the outermost that does is looked at. It is none if it shows a feature or a coverage: if its layer or block, that of
    an insert around or within it, or the layer of a stroke is named by a pattern of ``classes``, or like a class of
    the manifest or of the list of features; or if a stroke lies on one of ``areas``.

    An insert is *bound* if at least half of its loose ends lie within ``visible`` of other linework, crosswise or at a
    loose end of it; or if a loose end of other linework, not of the same block, lies so near to it (see
    :mod:`foparq.geom.standing`). It is a symbol

    - if its block is inserted, so small, at least ``times`` times, and fewer than half of these are bound; unless at
      least half of its own loose ends meet other linework;
    - if its block is inserted less often, and no other linework lies as near as ``clear``.

    Parameters
    ----------
    kinds : frozenset of str
        Classes of the list of features, as :func:`foparq.names.of_kind` makes them.
    hidden : bool
        True if off and frozen layers are looked at too.

    Notes
    -----
    O((s + near pairs) log s). Blocks without a name, and those that a program named, are one block where they hold as
    many lines and vertices, of the same length in all.
    """
    columns = Columns(drawing, hidden=hidden)
    lines = columns.build(Lines, np.arange(len(columns.rows)))
    assert isinstance(lines, Lines)  # noqa: S101 - what was asked for
    inserts = _Inserts(_grouped(lines))
    table, count = lines.polylines, len(inserts.holder)
    group = np.full(len(lines), NOBODY, dtype=np.intp)
    for level in inserts.levels:
        free = np.where(group == NOBODY, level, NOBODY)
        fits = fitting(table, free, count, size=measures.size)
        group = np.where((free != NOBODY) & fits[free], free, group) if count else group
    shown = _shows_features(drawing, lines, inserts, kinds)
    group[np.isin(group, group[shown])] = NOBODY
    chosen, group = np.unique(np.append(NOBODY, group), return_inverse=True)
    chosen, group = chosen[1:], group[1:] - 1  # numbered anew: candidates only
    if not len(chosen):
        return Symbols()
    block = _blocks(lines, group, [inserts.holder[n].block for n in chosen.tolist()])
    times = np.bincount(block)
    ends = joined(
        table, group, block, within=measures.visible / _ONE_PLACE, reach=measures.visible,
        alongside=measures.alongside,
    )  # fmt: skip
    bound = ends.held | (ends.loose > 0) & (2 * ends.near >= ends.loose)
    repeated = (times >= measures.times) & (2 * np.bincount(block, bound) < times)
    symbol = repeated[block] & ~((ends.loose > 0) & (2 * ends.met >= ends.loose))
    symbol |= alone(table, group, times[block] < measures.times, within=measures.clear)
    return _told(lines, inserts, group, chosen, block, symbol, ends.held | (ends.near > 0))


def _grouped(rows: Lines | Items) -> Texts:
    """(n,) holders of rows; a feature of several parts holds them like an insert whose block has no name."""
    holders: Texts = rows.holders.copy()
    alone = np.flatnonzero((holders == "") & (rows.item != rows.handle))
    named = [_PART.fullmatch(item) for item in rows.item[alone].tolist()]
    times = Counter(found[1] for found in named if found)
    for row, found in zip(alone.tolist(), named, strict=True):
        if found and times[found[1]] > 1:
            holders[row] = str(Holder(found[1], rows.layer[row], ""))
    return holders


class _Inserts:
    """Inserts of n lines, each numbered once; ``levels`` (n,) from the outermost inward, ``NOBODY`` where none is."""

    def __init__(self, holders: Texts) -> None:
        known: dict[str, int] = {}
        self.text: Index = np.array([known.setdefault(text, len(known)) for text in holders.tolist()], dtype=np.intp)
        self.holder: list[Holder] = []
        self._around: list[int] = []  # the insert that holds each
        numbers: dict[tuple[int, Holder], int] = {}
        self.chain = [self._numbered(text, numbers) for text in known]
        depth = max(map(len, self.chain), default=0)
        of_text = (
            np.array([chain[n] if n < len(chain) else NOBODY for chain in self.chain], dtype=np.intp)
            for n in range(depth)
        )
        self.levels = [level[self.text] for level in of_text]

    def _numbered(self, text: str, numbers: dict[tuple[int, Holder], int]) -> list[int]:
        chain: list[int] = []
        for holder in holders_of(text):
            around = chain[-1] if chain else NOBODY
            if (number := numbers.setdefault((around, holder), len(self.holder))) == len(self.holder):
                self.holder.append(holder)
                self._around.append(around)
            chain.append(number)
        return chain

    def way(self, number: int) -> str:
        """The way to an insert, as in ``Items.inserts``."""
        names = []
        while number != NOBODY:
            names.append(self.holder[number].name)
            number = self._around[number]
        return "/".join(reversed(names))


def _shows_features(drawing: Drawing, lines: Lines, inserts: _Inserts, kinds: frozenset[str]) -> Flags:
    """(n,) lines that are drawn as features or bound areas: by their layer, or by an insert that holds them."""
    patterns = tuple(drawing.classes)
    names = kinds | {of_kind(name) for name in drawing.classes.values()}
    known: dict[str, bool] = {}

    def shows(name: str) -> bool:
        if name not in known:
            words = {of_kind(name), *map(of_kind, re.findall(r"[^\W\d_]+", name))}
            known[name] = matches(name, patterns) or not names.isdisjoint(words)
        return known[name]

    held = [shows(holder.layer) or shows(holder.block) for holder in inserts.holder]
    by_text = np.array([any(held[n] for n in chain) for chain in inserts.chain], dtype=bool)
    layers, of_layer = np.unique(lines.layer.astype(str), return_inverse=True)
    by_layer = np.array([shows(name) or matches(name, drawing.areas) for name in layers.tolist()], dtype=bool)
    shown: Flags = by_text[inserts.text] | by_layer[of_layer]
    return shown


def _blocks(lines: Lines, group: Index, names: Sequence[str]) -> Index:
    """Number (g,) of the block of each insert, from 0."""
    count, mine = len(names), np.flatnonzero(group != NOBODY)
    of, table = group[mine], lines.polylines
    pieces, vertices = np.bincount(of, minlength=count), np.bincount(of, np.diff(table.offsets)[mine], count)
    length = summed(of, table.length[mine], count)
    order = np.lexsort((length, vertices, pieces))
    same = (np.diff(pieces[order]) == 0) & (np.diff(vertices[order]) == 0)
    same &= np.diff(length[order]) <= _ALIKE * length[order][1:] + table.slack
    form = np.empty(count, dtype=np.intp)
    form[order] = np.cumsum(np.append(True, ~same)) - 1
    keys = [
        (folded(name), NOBODY) if name and not name.startswith(_ANONYMOUS) else ("", shape)
        for name, shape in zip(names, form.tolist(), strict=True)
    ]
    numbers: dict[tuple[str, int], int] = {}
    return np.array([numbers.setdefault(key, len(numbers)) for key in keys], dtype=np.intp)


def _told(
    lines: Lines, inserts: _Inserts, group: Index, chosen: Index, block: Index, symbol: Flags, near: Flags
) -> Symbols:  # fmt: skip
    """The symbols with their blocks; of one block without a name, every form by itself."""
    stroke = np.flatnonzero((group != NOBODY) & symbol[group])
    layers: dict[int, dict[str, set[int]]] = {}
    for layer, one in zip(lines.layer[stroke].tolist(), group[stroke].tolist(), strict=True):
        layers.setdefault(int(block[one]), {}).setdefault(layer, set()).add(one)
    blocks = []
    for number, on in layers.items():
        mine = np.flatnonzero(symbol & (block == number))
        names = sorted({inserts.holder[n].block for n in chosen[mine].tolist()})
        ways = sorted(inserts.way(n) for n in chosen[mine].tolist())
        blocks.append(
            SymbolBlock(
                name=names[0], inserts=len(mine), near=int(np.count_nonzero(near[mine])),
                layers=tuple((layer, len(on[layer])) for layer in sorted(on)), handles=tuple(ways[:_HANDLES]),
            )
        )  # fmt: skip
    blocks.sort(key=lambda one: (one.name, one.handles))
    return Symbols(rows=union(lines.row[stroke]), blocks=tuple(blocks))
