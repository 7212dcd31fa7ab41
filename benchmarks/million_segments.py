# SPDX-License-Identifier: MIT
"""Time and memory of ``foparq check`` with all line rules on 10 000, 100 000 and 1 000 000 segments.

Run by hand::

    uv run python benchmarks/million_segments.py [SEGMENTS ...]

The drawings are seeded: lines of ten segments that wander, 100 segments a square metre whatever the size, segments so
long that they cross about 0.22 times each. They are made once in ``benchmarks/data``. The table tells seconds and peak
memory of the whole process, from start to exit, and the growth exponent between two sizes.
"""

import json
import math
import resource
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pyogrio
import shapely

DATA = Path(__file__).with_name("data")
STEPS, DENSITY, CROSSINGS = 10, 100.0, 0.22
LOCAL = 'LOCAL_CS["sheet", UNIT["metre", 1]]'
OPTIONS = ("--unit", "m", "--scale", "1:50", "--format", "json")


def drawing(segments: int) -> Path:
    """GeoPackage of random lines, made if it is not there."""
    path = DATA / f"segments_{segments}.gpkg"
    if path.exists():
        return path
    DATA.mkdir(exist_ok=True)
    rng = np.random.default_rng(segments)
    lines = segments // STEPS
    # Straight segments of length l at density d cross each other d l**2 / pi times a segment.
    length = math.sqrt(CROSSINGS * math.pi / DENSITY) * rng.uniform(0.5, 1.5, (lines, STEPS))
    heading = rng.uniform(0, 2 * np.pi, (lines, 1)) + np.cumsum(rng.normal(0, 0.5, (lines, STEPS)), axis=1)
    step = np.stack([length * np.cos(heading), length * np.sin(heading)], axis=2)
    start = rng.uniform(0, math.sqrt(segments / DENSITY), (lines, 1, 2))
    shapes = shapely.linestrings(np.concatenate([start, start + np.cumsum(step, axis=1)], axis=1))
    pyogrio.raw.write(
        path,
        shapely.to_wkb(shapes),
        field_data=[],
        fields=[],
        layer="lines",
        driver="GPKG",
        geometry_type="LineString",
        crs=LOCAL,
    )
    return path


def measure(path: Path) -> tuple[float, float, dict[str, int]]:
    """Seconds, peak megabytes and findings by rule of one run.

    The peak is that of the largest child so far: sizes are run from small to large.
    """
    begin = time.perf_counter()
    command = [sys.executable, "-m", "foparq", "check", str(path), *OPTIONS]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    seconds = time.perf_counter() - begin
    if done.returncode not in {0, 1}:
        raise SystemExit(f"foparq check ended with {done.returncode}:\n{done.stderr}")
    peak = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
    return seconds, peak, json.loads(done.stdout)["findings"]["by_name"]


def main() -> None:
    """Print the table."""
    sizes = sorted(int(text) for text in sys.argv[1:]) or [10_000, 100_000, 1_000_000]
    print(f"{'segments':>10} {'seconds':>8} {'MB':>6} {'exponent':>8}  findings")
    last: tuple[int, float] | None = None
    for size in sizes:
        seconds, peak, found = measure(drawing(size))
        growth = f"{math.log(seconds / last[1]) / math.log(size / last[0]):8.2f}" if last else f"{'':8}"
        named = ", ".join(f"{name} {count}" for name, count in sorted(found.items()))
        print(f"{size:>10} {seconds:>8.2f} {peak:>6.0f} {growth}  {named}", flush=True)
        last = (size, seconds)


if __name__ == "__main__":
    main()
