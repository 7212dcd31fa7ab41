# SPDX-License-Identifier: MIT
"""How often distances say rightly whether the drawing or the reference is wrong at an outlying point.

    uv run python benchmarks/outlying_points.py

Facades of 30 m by 10 m, survey and tape of 3 mm, differences of the drawing of 4 mm; one point is wrong by a given
length in a random direction, mostly within the facade. Four thousand samples a line.
"""

import numpy as np

from foparq.evaluate.witnessed import suspected

SURVEY, TAPE, DRAWING = 0.003, 0.003, 0.004


def shares(size: float, wrong: str, n: int, samples: int, rng: np.random.Generator) -> dict[str, float]:
    """Shares of samples in which drawing, reference or nothing is named."""
    told = {"drawing": 0, "reference": 0, "": 0}
    for _ in range(samples):
        points = rng.uniform([0, 0, 0], [30, 0.5, 10], (n + 1, 3))
        error = rng.normal(size=3)
        error *= (size, 0.2 * size, size) / np.linalg.norm(error)
        drawn, surveyed = (points + rng.normal(0.0, sd, points.shape) for sd in (DRAWING, SURVEY))
        if wrong == "drawing":
            drawn[0] += error
        else:
            surveyed[0] -= error
        taped = np.linalg.norm(points[1:] - points[0], axis=1) + rng.normal(0.0, TAPE, n)
        found = np.linalg.norm(drawn[1:] - drawn[0], axis=1) - taped
        usual = np.full(3, np.hypot(DRAWING, SURVEY))
        told[suspected(drawn[0] - drawn[1:], drawn[0] - surveyed[0], found, usual, TAPE).which] += 1
    return {which: count / samples for which, count in told.items()}


def main() -> None:
    """Print a table."""
    rng = np.random.default_rng(20261130)
    print("size (mm)  wrong      distances  right   wrongly named")
    for size in (0.015, 0.03, 0.06, 0.2):
        for wrong in ("drawing", "reference"):
            other = "reference" if wrong == "drawing" else "drawing"
            for n in (1, 3):
                told = shares(size, wrong, n, 4000, rng)
                print(f"{1000 * size:9.0f}  {wrong:9}  {n:9}  {told[wrong]:5.1%}  {told[other]:6.2%}")


if __name__ == "__main__":
    main()
