# SPDX-License-Identifier: MIT
"""Block inserts that are taken for point symbols: signs on the drawing, and no linework of it."""

from dataclasses import dataclass, field

import numpy as np

from foparq.columns import Index


@dataclass(frozen=True, slots=True, kw_only=True)
class SymbolBlock:
    """One block whose inserts are taken for point symbols."""

    name: str  #: ``""`` if the file does not tell, as a CAD export
    inserts: int
    near: int  #: of these, where other linework and theirs end at each other
    layers: tuple[tuple[str, int], ...]  #: layers of their strokes, each with the inserts that have strokes there
    handles: tuple[str, ...] = ()  #: the first few, as in ``Items.inserts``


@dataclass(frozen=True, kw_only=True)
class Symbols:
    """Point symbols of one drawing."""

    rows: Index = field(default_factory=lambda: np.empty(0, dtype=np.intp))  #: (k,) rows of the items that draw them
    blocks: tuple[SymbolBlock, ...] = ()  #: in order of their names
    broken: str = ""  #: why nobody knows, as :class:`foparq.findings.because.Because`

    @property
    def inserts(self) -> int:
        """Inserts of all blocks."""
        return sum(block.inserts for block in self.blocks)
