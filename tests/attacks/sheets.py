# SPDX-License-Identifier: MIT
"""Attacks by one unit for everything: drawing and tables agree, and the building fits on no sheet."""

from typing import Any

import numpy as np
from tests.attacks.kinds import DXF, attack
from tests.tools.offices import Office

_UNIT = ("checks.unit-contradicted", "features.unit-contradicted")
#: neither header nor lettering says a unit
SILENT: dict[str, Any] = {
    **DXF,
    "version": "R2013",
    "lettering": "",
    "header": 0,
    "digits": 4,
    "ends_by": "checkpoints",
}
METRES: dict[str, Any] = {**SILENT, "unit": "m", "table_unit": "m"}
MILLIMETRES: dict[str, Any] = {**SILENT, "unit": "mm", "table_unit": "mm"}


def _all_stated(office: Office, unit: str) -> Office:
    return office.state("drawing", unit=unit).state("checkpoints", unit=unit).state("distances", unit=unit)


@attack(
    "metres throughout, stated in another unit throughout", *_UNIT, office={**SILENT, "unit": "m", "table_unit": "m"}
)
def _metres(office: Office, rng: np.random.Generator) -> Office:
    return _all_stated(office, str(rng.choice(["mm", "km"])))


@attack(
    "millimetres throughout, stated in metres throughout", *_UNIT, office={**SILENT, "unit": "mm", "table_unit": "mm"}
)
def _millimetres(office: Office, _: np.random.Generator) -> Office:
    return _all_stated(office, "m")


@attack("metres stated in millimetres, without tables", *_UNIT, office=METRES)
def _alone(office: Office, _: np.random.Generator) -> Office:
    return _all_stated(office, "mm").state("checkpoints", path=None).state("distances", path=None)


@attack(
    "millimetres under a header of metres, tables in metres too", "evidence.unit-doubted",
    office={**MILLIMETRES, "header": 6},
)  # fmt: skip
def _header(office: Office, _: np.random.Generator) -> Office:
    return _all_stated(office, "m").state("drawing", unit=None)
