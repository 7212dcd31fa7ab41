# SPDX-License-Identifier: MIT
"""Attacks on the reference: surveyed and delivered values of one table that are not written alike."""

import numpy as np
from tests.attacks.kinds import BY_NAME, CLEAR, attack
from tests.tools.offices import Office

FROM_MARKS = {"told": False, "targets": "block", "format": "dxf", "blocks": "own", "ends_by": "names", "n": 9}


def _factor(
    rng: np.random.Generator, among: tuple[float, ...] = (1000.0, 100.0, 1 / 0.0254, 1 / 0.3048, 0.01)
) -> float:
    return float(rng.choice(among))


@attack("surveyed coordinates in another unit", "evidence.reference-unit", office={**CLEAR, "table_unit": "m"})
def _surveyed(office: Office, rng: np.random.Generator) -> Office:
    return office.change(surveyed=office.surveyed * _factor(rng))


@attack(
    "surveyed coordinates in another unit, delivered taken from marks", "evidence.reference-unit", office=FROM_MARKS
)
def _marks(office: Office, rng: np.random.Generator) -> Office:
    return office.change(surveyed=office.surveyed * _factor(rng, (1000.0, 100.0)))


@attack("surveyed columns exchanged", "evidence.reference-axes", office=CLEAR)
def _columns(office: Office, rng: np.random.Generator) -> Office:
    orders = [[0, 2, 1], [2, 1, 0], [1, 0, 2], [1, 2, 0], [2, 0, 1]]
    return office.change(surveyed=office.surveyed[:, orders[int(rng.integers(len(orders)))]])


@attack("measured lengths in another unit", "evidence.reference-lengths", office={**CLEAR, "ends_by": "checkpoints"})
def _measured(office: Office, rng: np.random.Generator) -> Office:
    return office.change(measured=office.measured * _factor(rng))


@attack("measured lengths in another unit, by name", "evidence.reference-lengths", office={**BY_NAME, "digits": 4})
def _by_name(office: Office, rng: np.random.Generator) -> Office:
    return office.change(measured=office.measured * _factor(rng, (1000.0, 100.0, 1 / 0.3048)))


@attack("surveyed a metre aside", "absolute.fail", verdict="rejected", office={**CLEAR, "table_unit": "m", "scale": 50})
def _aside(office: Office, _: np.random.Generator) -> Office:
    return office.change(surveyed=office.surveyed + np.array([1.0, 0.0, 0.0]))


@attack("measured lengths a tenth too long", "relative.fail", verdict="rejected", office={**CLEAR, "scale": 50})
def _long(office: Office, _: np.random.Generator) -> Office:
    return office.change(measured=office.measured * 1.1)
