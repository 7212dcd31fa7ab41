# SPDX-License-Identifier: MIT
"""A register of inputs that are large, slow or mean harm; each is a function that writes one."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from io import StringIO
from pathlib import Path

import ezdxf
import numpy as np
from numpy.typing import NDArray

Points = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class Job:
    """One run of foparq."""

    path: Path  #: file to check, or folder to audit
    seconds: float  #: most that it may take
    exits: frozenset[int]  #: exit codes that are right
    command: str = "check"

    def arguments(self) -> list[str]:
        return [self.command, str(self.path), *(["--scale", "1:50", "--unit", "m"] if self.command == "check" else [])]


Make = Callable[[Path], Job]

#: name to what makes it
INPUTS: dict[str, Make] = {}


def drawing(
    *, seconds: float = 20, exits: Sequence[int] = (0, 1, 3, 4), suffix: str = ".dxf", command: str = "check"
) -> Callable[[Callable[[Path], object]], Callable[[Path], object]]:
    """Register a function that writes one file; its name, with dashes, names the input."""

    def register(write: Callable[[Path], object]) -> Callable[[Path], object]:
        name = write.__name__.replace("_", "-")

        def make(folder: Path) -> Job:
            path = folder / f"{name}{suffix}"
            # A function may choose another path than the one it is given.
            chosen = write(path)
            return Job(
                path=chosen if isinstance(chosen, Path) else path,
                seconds=seconds, exits=frozenset(exits), command=command,
            )  # fmt: skip

        INPUTS[name] = make
        return write

    return register


def write_dxf(
    path: Path, *, entities: str = "", layers: Sequence[str] = (), blocks: str = "", version: str = "R2010"
) -> None:
    """DXF file around texts of entities and blocks, with the layers named."""
    document = ezdxf.new(version)
    document.header["$INSUNITS"] = 6
    document.layers.add("RESERVED")
    stream = StringIO()
    document.write(stream)
    text = stream.getvalue()
    start = text.index("  0\nSECTION\n  2\nENTITIES\n")
    head, rest = text[:start], text[start + len("  0\nSECTION\n  2\nENTITIES\n") :]
    if blocks:
        end = head.rindex("  0\nENDSEC\n")
        head = head[:end] + blocks + head[end:]
    if layers:
        handle = 0x70000000
        table = "".join(
            f"  0\nLAYER\n  5\n{handle + n:X}\n100\nAcDbSymbolTableRecord\n100\nAcDbLayerTableRecord\n"
            f"  2\n{name}\n 70\n0\n 62\n7\n  6\nContinuous\n"
            for n, name in enumerate(layers)
        )
        reserved = head.index("\n  2\nRESERVED\n")
        end = head.index("  0\nENDTAB\n", reserved)
        head = head[:end] + table + head[end:]
    with path.open("w", encoding="utf-8") as out:
        out.write(head)
        out.write("  0\nSECTION\n  2\nENTITIES\n")
        out.write(entities)
        out.write(rest)


def line(x0: float, y0: float, x1: float, y1: float, *, layer: str = "0") -> str:
    """LINE, as R12 writes it."""
    return f"  0\nLINE\n  8\n{layer}\n 10\n{x0!r}\n 20\n{y0!r}\n 11\n{x1!r}\n 21\n{y1!r}\n"


def polyline(points: Points, *, layer: str = "0", closed: bool = False) -> str:
    """LWPOLYLINE of points, (n, 2)."""
    rows = "".join(f" 10\n{x!r}\n 20\n{y!r}\n" for x, y in points.tolist())
    head = f"  0\nLWPOLYLINE\n100\nAcDbEntity\n  8\n{layer}\n100\nAcDbPolyline\n"
    return f"{head} 90\n{len(points)}\n 70\n{int(closed)}\n{rows}"


def insert(name: str, x: float, y: float, *, more: str = "") -> str:
    """INSERT of a block."""
    return f"  0\nINSERT\n100\nAcDbEntity\n  8\n0\n{more}100\nAcDbBlockReference\n  2\n{name}\n 10\n{x!r}\n 20\n{y!r}\n"


def block(name: str, content: str) -> str:
    """Definition of a block."""
    return (
        f"  0\nBLOCK\n100\nAcDbEntity\n  8\n0\n100\nAcDbBlockBegin\n"
        f"  2\n{name}\n 70\n0\n 10\n0.0\n 20\n0.0\n  3\n{name}\n"
        f"{content}  0\nENDBLK\n100\nAcDbEntity\n  8\n0\n100\nAcDbBlockEnd\n"
    )
