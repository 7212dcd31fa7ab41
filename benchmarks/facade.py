# SPDX-License-Identifier: MIT
"""Processor time of ``foparq check`` on facade-like linework, beside a bare shapely script in the same run.

Run by hand::

    uv run python benchmarks/facade.py [SEGMENTS ...] [--dxf]

The drawings are seeded: storeys of bays with walls, frames, glazing bars, mouldings, a round arch and a hatch whose
lines end on their frame, as in a real elevation. One end in five hundred is drawn a little short or long, one line in a
thousand twice. They are made once in ``benchmarks/data``. Time is user and system time of the process and its children.
"""

import os
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pyogrio
import shapely
from numpy.typing import NDArray

Ways = list[NDArray[np.float64]]

DATA = Path(__file__).with_name("data")
YARDSTICK = Path(__file__).with_name("facade_yardstick.py")
LOCAL = 'LOCAL_CS["sheet", UNIT["metre", 1]]'
OPTIONS = ("--unit", "m", "--scale", "1:50", "--format", "json")
BAY = np.array([3.0, 4.0])  #: metres


def box(x0: float, y0: float, x1: float, y1: float) -> NDArray[np.float64]:
    """Closed rectangle."""
    return np.array([(x0, y0), (x1, y0), (x1, y1), (x0, y1), (x0, y0)])


def bay() -> Ways:
    """Linework of one bay; what neighbours share is drawn by one of them."""
    width, height = BAY
    ways = [np.array([(0, 0), (0, height)]), np.array([(0, 0), (width, 0)])]
    ways += [np.array([(0, y), (width, y)]) for y in (0.12, 0.18, 3.7)]
    ways += [box(0.8, 1.1, 2.2, 3.0), box(0.87, 1.17, 2.13, 2.93)]
    ways += [np.array([(x, 1.17), (x, 2.93)]) for x in (1.185, 1.5, 1.815)]
    ways += [np.array([(0.87, y), (2.13, y)]) for y in (1.61, 2.05, 2.49)]
    angle = np.linspace(np.pi, 0, 25)
    ways.append(np.column_stack([1.5 + 0.7 * np.cos(angle), 3.0 + 0.35 * np.sin(angle)]))
    sill = [(0.7, 1.0), (0.7, 1.03), (0.72, 1.05), (0.75, 1.06), (0.75, 1.09), (2.25, 1.09), (2.25, 1.06), (2.28, 1.05)]
    ways.append(np.array([*sill, (2.3, 1.03), (2.3, 1.0), (0.7, 1.0)]))
    ways.append(box(0.9, 0.3, 2.1, 0.9))
    for start in np.arange(-0.57, 1.2, 0.03):  # hatch at 45 degrees, clipped to its frame
        low, high = max(start, 0.0), min(start + 0.6, 1.2)
        ways.append(np.array([(0.9 + low, 0.3 + low - start), (0.9 + high, 0.3 + high - start)]))
    return ways


def facade(segments: int) -> NDArray[np.object_]:
    """Lines of a facade of about so many segments."""
    rng = np.random.default_rng(segments)
    template = bay()
    bays = max(1, round(segments / sum(len(way) - 1 for way in template)))
    wide = int(np.ceil(np.sqrt(bays * BAY[1] / BAY[0])))
    bays = -(-bays // wide) * wide
    corner = np.column_stack([np.arange(bays) % wide, np.arange(bays) // wide])[:, None] * BAY
    lines = []
    for way in template:
        drawn = np.round(way + corner, 4)
        if len(way) == 2:  # a straight line: some are drawn short or long
            along = (drawn[:, 1] - drawn[:, 0]) / np.linalg.norm(way[1] - way[0])
            wrong = rng.random(bays) < 1 / 250
            drawn[wrong, 1] += along[wrong] * rng.choice([-0.004, 0.004], (np.count_nonzero(wrong), 1))
        lines.append(shapely.linestrings(drawn))
    far = BAY * [wide, bays // wide]
    lines.append(shapely.linestrings([[(far[0], 0), far], [(0, far[1]), far]]))
    made = np.concatenate(lines)
    made = np.concatenate([made, made[rng.random(len(made)) < 1 / 1000]])
    return made[rng.permutation(len(made))]


def geopackage(segments: int) -> Path:
    """The drawing as a GeoPackage, made if it is not there."""
    path = DATA / f"facade_{segments}.gpkg"
    if not path.exists():
        DATA.mkdir(exist_ok=True)
        pyogrio.raw.write(
            path, shapely.to_wkb(facade(segments)), field_data=[], fields=[], layer="lines", driver="GPKG",
            geometry_type="LineString", crs=LOCAL,
        )  # fmt: skip
    return path


def dxf(segments: int) -> Path:
    """The drawing as a DXF, made if it is not there."""
    path = DATA / f"facade_{segments}.dxf"
    if not path.exists():
        import ezdxf  # noqa: PLC0415 - slow to import, and not needed for GeoPackages

        DATA.mkdir(exist_ok=True)
        drawing = ezdxf.new("R2010", units=6)
        space = drawing.modelspace()
        for line in facade(segments):
            space.add_lwpolyline(shapely.get_coordinates(line))
        drawing.saveas(path)
    return path


def measure(*command: str) -> tuple[float, float, float]:
    """Processor seconds, seconds on the clock and peak megabytes of a process with its children."""
    begin = time.perf_counter()
    process = subprocess.Popen([sys.executable, *command], stdout=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode not in {0, 1}:
        raise SystemExit(f"{' '.join(command)} ended with {process.returncode}")
    return usage.ru_utime + usage.ru_stime, time.perf_counter() - begin, usage.ru_maxrss / 1024


def main() -> None:
    """Print the table: the best of three runs each, in turns."""
    sizes = sorted(int(text) for text in sys.argv[1:] if text.isdigit()) or [10_000, 100_000, 1_000_000]
    print(f"{'drawing':>22} {'foparq cpu':>10} {'clock':>6} {'MB':>5} {'yardstick cpu':>13} {'ratio':>6}")
    for size in sizes:
        paths = [geopackage(size), *([dxf(size)] if "--dxf" in sys.argv else [])]
        for path in paths:
            ours, plain = [], []
            for _ in range(3):
                ours.append(measure("-m", "foparq", "check", str(path), *OPTIONS))
                plain.append(measure(str(YARDSTICK), str(geopackage(size))))
            (cpu, clock, peak), (yard, *_) = min(ours), min(plain)
            print(
                f"{path.name:>22} {cpu:>10.2f} {clock:>6.2f} {peak:>5.0f} {yard:>13.2f} {cpu / yard:>6.2f}", flush=True
            )


if __name__ == "__main__":
    main()
