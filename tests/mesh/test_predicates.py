# SPDX-License-Identifier: MIT
"""Exact arithmetic and exact signs, against rational numbers."""

import re
from fractions import Fraction
from itertools import pairwise

import numba
import numpy as np
import pytest
from numpy.typing import NDArray

from foparq.mesh import predicates
from foparq.mesh.determinants import WORKSPACE
from foparq.mesh.expansions import add, scale, two_difference, two_product, two_sum
from foparq.mesh.predicates import LARGEST, SMALLEST, orientation, safe

N = 3000
UTM = np.array([712345.678, 7456789.123, 812.5])


def sign_of_determinant(rows: list[list[float]]) -> int:
    """Of the points as rows of their differences to the last one, in rational arithmetic."""
    exact = [[Fraction(value) for value in row] for row in rows]
    m = [[a - b for a, b in zip(row, exact[-1], strict=True)] for row in exact[:-1]]
    if len(m) == 2:
        value = m[0][0] * m[1][1] - m[0][1] * m[1][0]
    else:
        (a, b, c), (d, e, f), (g, h, i) = m
        value = a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)
    return (value > 0) - (value < 0)


def in_one_plane(rng: np.random.Generator, n: int = N) -> NDArray[np.float64]:
    """Quadruples (4, n, 3) of one plane, but for rounding."""
    a, b, c = rng.normal(size=(3, n, 3))
    u, v = rng.uniform(size=(2, n, 1))
    return np.stack([a, b, c, a + (b - a) * u + (c - a) * v])


def quadruples(kind: str) -> NDArray[np.float64]:
    rng = np.random.default_rng(20261130)
    points = in_one_plane(rng)
    if kind == "random":
        points = rng.normal(size=(4, N, 3))
    elif kind == "grid":
        points = rng.integers(-3, 4, size=(4, N, 3)).astype(float)
    elif kind == "grid of tenths":
        points = rng.integers(-3, 4, size=(4, N, 3)) / 10
    elif kind == "georeferenced":
        points = points + UTM
    elif kind == "georeferenced grid":
        points = rng.integers(-3, 4, size=(4, N, 3)) / 8 + UTM
    elif kind == "tiny":
        points = points * 1e-12
    elif kind == "huge":
        points = points * 1e8
    elif kind == "exactly in the plane x = y":
        points[..., 1] = points[..., 0]
    elif kind == "exactly in the plane z = x + y, whole numbers":
        points = rng.integers(-(2**50), 2**50, size=(4, N, 3)).astype(float)
        points[..., 2] = points[..., 0] + points[..., 1]
    elif kind == "one bit off the plane x = y":
        points[..., 1] = points[..., 0]
        points[3, :, 1] = np.nextafter(points[3, :, 1], np.inf)
    elif kind == "of many sizes":
        points = rng.normal(size=(4, N, 3)) * np.exp2(rng.integers(-280, 280, size=(4, N, 3)))
    elif kind == "in one plane, of many sizes":
        points[..., 1] = points[..., 0] = points[..., 0] * np.exp2(rng.integers(-280, 280, size=(4, N)))
    elif kind == "at the lower limit":
        points = points * 2.0**-297
    elif kind == "at the upper limit":
        points = points * 2.0**296
    elif kind == "repeated points":
        points[1, ::2], points[3, ::3] = points[0, ::2], points[2, ::3]
    size = np.abs(points)
    return np.where((size >= SMALLEST) & (size <= LARGEST), points, 0.0)


KINDS = (
    "random", "in one plane but for rounding", "grid", "grid of tenths", "georeferenced", "georeferenced grid", "tiny",
    "huge", "exactly in the plane x = y", "exactly in the plane z = x + y, whole numbers",
    "one bit off the plane x = y",
    "of many sizes", "in one plane, of many sizes", "at the lower limit", "at the upper limit", "repeated points",
)  # fmt: skip


@pytest.mark.parametrize("kind", KINDS)
def test_signs_in_space_are_those_of_rational_arithmetic(kind: str) -> None:
    points = quadruples(kind)
    known = [sign_of_determinant(list(rows)) for rows in points.swapaxes(0, 1).tolist()]
    assert orientation(*points).tolist() == known
    # Swapping two points changes the side.
    assert orientation(*points[[1, 0, 2, 3]]).tolist() == [-sign for sign in known]


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("flat", [False, True], ids=["as they are", "on one line but for rounding"])
def test_signs_in_the_plane_are_those_of_rational_arithmetic(kind: str, flat: bool) -> None:  # noqa: FBT001
    points = quadruples(kind)[:3, :, :2]
    if flat:
        points[2] = points[0] / 2 + points[1] / 2
        points[2][np.abs(points[2]) < SMALLEST] = 0.0
    known = [sign_of_determinant(list(rows)) for rows in points.swapaxes(0, 1).tolist()]
    assert orientation(*points).tolist() == known


def test_the_kinds_hold_what_their_names_say() -> None:
    zero = (orientation(*quadruples("exactly in the plane x = y")) == 0).mean()
    assert zero == 1
    assert (orientation(*quadruples("one bit off the plane x = y")) != 0).mean() > 0.99
    assert 0.01 < (orientation(*quadruples("grid")) == 0).mean() < 0.5


@pytest.mark.parametrize("wrong", [np.nan, np.inf, -np.inf, SMALLEST / 2, -LARGEST * 2, 5e-324, 1e308])
def test_coordinates_that_arithmetic_cannot_hold_are_refused(wrong: float) -> None:
    points = quadruples("random")
    points[2, 7, 1] = wrong
    assert np.flatnonzero(~safe(points[2])).tolist() == [7]
    with pytest.raises(ValueError, match="not finite, or too large or too small"):
        orientation(*points)


def test_limits_and_zeros_of_both_signs_are_safe() -> None:
    assert safe(np.array([[SMALLEST, -SMALLEST, 0.0], [LARGEST, -LARGEST, -0.0]])).all()


def test_sums_and_products_leave_nothing_out() -> None:
    rng = np.random.default_rng(3)
    for a, b in (rng.normal(size=(4000, 2)) * np.exp2(rng.integers(-90, 90, size=(4000, 2)))).tolist():
        x, y = Fraction(a), Fraction(b)
        for known, (head, rest) in (
            (x + y, two_sum(a, b)), (x - y, two_difference(a, b)), (x * y, two_product(a, b)),
        ):  # fmt: skip
            assert Fraction(head) + Fraction(rest) == known
            # The first is the rounded result: the rest does not reach it.
            assert head + rest == head


def lowest_bit(value: float) -> Fraction:
    exact = Fraction(value)
    return Fraction(exact.numerator & -exact.numerator, exact.denominator)


def test_expansions_add_and_scale_exactly_and_stay_ordered() -> None:
    rng = np.random.default_rng(4)
    w = np.zeros(200)
    for _ in range(500):
        count, value = 0, Fraction(0)
        at, other = 0, 60
        for term in (rng.normal(size=8) * np.exp2(rng.integers(-60, 60, size=8))).tolist():
            w[150] = term
            count = add(w, at, count, 150, 1, other)
            at, other = other, at
            value += Fraction(term)
        factor = float(rng.normal())
        scaled = scale(w, at, count, factor, 100)
        parts, times = w[at : at + count].tolist(), w[100 : 100 + scaled].tolist()
        assert sum(map(Fraction, parts)) == value
        assert sum(map(Fraction, times)) == value * Fraction(factor)
        for expansion in (parts, times):
            assert all(expansion)
            assert all(abs(Fraction(a)) < lowest_bit(b) for a, b in pairwise(expansion))


def test_nothing_is_left_of_a_sum_that_vanishes() -> None:
    w = np.array([1e-30, 1.0, -1e-30, -1.0, 0.0, 0.0, 0.0, 0.0])
    assert add(w, 0, 2, 2, 2, 4) == 0
    assert scale(w, 0, 2, 0.0, 4) == 0
    assert scale(w, 0, 0, 3.0, 4) == 0


@pytest.mark.parametrize("kernel", ["orient2d", "orient3d"])
def test_products_are_not_fused_with_sums(kernel: str) -> None:
    # A fused product would still be exact in Dekker's product, and would void the error bounds of the filter.
    quadruple, w = np.random.default_rng(1).normal(size=(4, 3)), np.empty(WORKSPACE)
    kept = getattr(predicates, kernel)
    # What comes from the cache keeps no listing.
    fresh = numba.njit(
        **{name: value for name, value in kept.targetoptions.items() if name not in {"cache", "nopython"}}
    )(kept.py_func)
    fresh(quadruple, 0, 1, 2, *((3, w) if kernel == "orient3d" else (0, 1, w)))
    code = "".join(fresh.inspect_asm().values()) + "".join(fresh.inspect_llvm().values())
    assert re.search(r"\bv?mulsd|fmul", code)
    assert not re.search(r"\bv?fn?m(add|sub)|\bfml[as]\b|llvm\.fma|fmul fast|fmul contract", code)
