# SPDX-License-Identifier: MIT
"""Keys of findings: what they depend on, and what they do not."""

import re

import numpy as np
import pytest

from foparq.findings.table import finding_keys

GRID = 0.001
PLACE = (10.25, -3.5, 0.125)


def key(
    rule: str = "TOP021", layer: str = "WALL", item: str = "2F", other: str = "3A", place: tuple[float, ...] = PLACE
) -> str:
    (made,) = keys([(rule, layer, item, other, place)])
    return made


def keys(rows: list[tuple[str, str, str, str, tuple[float, ...]]]) -> list[str]:
    rule = rows[0][0]
    columns = [np.array([row[part] for row in rows], dtype=object) for part in (1, 2, 3)]
    places = np.array([row[4] for row in rows], dtype=float)
    return finding_keys(rule, *columns, places, GRID).tolist()


def test_a_key_names_its_rule() -> None:
    assert re.fullmatch(r"TOP021-[0-9a-f]{10}", key())


def test_which_item_is_the_other_does_not_matter() -> None:
    assert key(item="3A", other="2F") == key()
    assert key(item="", other="2F") == key(item="2F", other="")


@pytest.mark.parametrize(
    "changed",
    [
        {"rule": "TOP022"}, {"layer": "WALL2"}, {"item": "30"}, {"other": "30"}, {"other": ""},
        {"place": (10.252, -3.5, 0.125)}, {"place": (10.25, -3.502, 0.125)}, {"place": (10.25, -3.5, 0.127)},
        {"place": (10.25, 3.5, 0.125)}, {"place": (-3.5, 10.25, 0.125)}, {"layer": "wall"},
    ],
    ids=str,
)  # fmt: skip
def test_another_rule_layer_item_or_place_is_another_key(changed: dict) -> None:
    assert key(**changed) != key()


def test_texts_that_join_alike_are_told_apart() -> None:
    assert key(layer="A", item="BC") != key(layer="AB", item="C")
    assert key(item="12", other="3") != key(item="1", other="23")


def test_noise_of_coordinates_is_no_other_place() -> None:
    noise = 0.0004
    assert {key(place=(x + dx, y + dy, z + dz)) for x, y, z in [PLACE] for dx in (-noise, noise)
            for dy in (-noise, noise) for dz in (-noise, noise)} == {key()}  # fmt: skip


def test_a_place_far_away_or_none_has_a_key_of_its_own() -> None:
    nowhere = key(place=(np.nan, np.nan, np.nan))
    assert nowhere == key(place=(0.0, 0.0, 0.0))
    assert key(place=(1e300, 0.0, 0.0)) != key(place=(-1e300, 0.0, 0.0))


def test_findings_that_share_a_key_are_numbered_in_order() -> None:
    row = ("TOP021", "WALL", "2F", "3A", PLACE)
    swapped = ("TOP021", "WALL", "3A", "2F", PLACE)
    apart = ("TOP021", "WALL", "2F", "3B", PLACE)
    assert keys([row, apart, swapped, row]) == [key(), key(other="3B"), f"{key()}-2", f"{key()}-3"]


def test_order_of_findings_changes_no_key() -> None:
    rows = [("TOP021", layer, item, "", PLACE) for layer in "AB" for item in ("1", "2", "3")]
    assert keys(rows[::-1]) == keys(rows)[::-1]
    assert len(set(keys(rows))) == len(rows)
