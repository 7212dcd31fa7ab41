# SPDX-License-Identifier: MIT
"""Every $INSUNITS code of the DXF reference: what one drawing unit is in metres."""

import math
from pathlib import Path

import ezdxf
import ezdxf.units
import pytest
from tests.read.drawn import new, read_back

from foparq.model.drawing import UnitOrigin
from foparq.read.dxf.units import drawing_unit

_SURVEY_FOOT = 1200 / 3937
#: metres in one unit: international yard and pound agreement, SI prefixes, IAU 2012 and 2015, Mendenhall order 1893
CODES = {
    1: 0.0254, 2: 0.3048, 3: 1609.344, 4: 0.001, 5: 0.01, 6: 1.0, 7: 1000.0, 8: 0.0254e-6, 9: 0.0254e-3, 10: 0.9144,
    11: 1e-10, 12: 1e-9, 13: 1e-6, 14: 0.1, 15: 10.0, 16: 100.0, 17: 1e9, 18: 149_597_870_700.0,
    19: 299_792_458.0 * 365.25 * 86_400, 20: 149_597_870_700.0 * 648_000 / math.pi, 21: _SURVEY_FOOT,
    22: _SURVEY_FOOT / 12, 23: _SURVEY_FOOT * 3, 24: _SURVEY_FOOT * 5280,
}  # fmt: skip


def test_all_codes_that_name_a_unit_are_here() -> None:
    assert sorted(CODES) == list(range(1, 25))


@pytest.mark.parametrize(("code", "metres"), CODES.items())
def test_code_in_metres(code: int, metres: float) -> None:
    unit = drawing_unit(new(insunits=code).header, None)
    assert unit.metres == pytest.approx(metres, rel=1e-14)
    assert unit.header_metres == unit.metres
    assert unit.origin is UnitOrigin.HEADER
    assert unit.name == unit.header != ""


@pytest.mark.parametrize("code", [*range(1, 8), *range(10, 20)])
def test_code_agrees_with_the_factors_of_ezdxf(code: int) -> None:
    metres = drawing_unit(new(insunits=code).header, None).metres
    # ezdxf states the astronomic units to four digits, and has no factor for the other codes.
    assert metres == pytest.approx(ezdxf.units.conversion_factor(code, 6), rel=2e-4)


@pytest.mark.parametrize("code", [0, 25, 99, -1])
def test_code_that_names_no_unit_leaves_it_unknown(code: int) -> None:
    unit = drawing_unit(new(insunits=code).header, None)
    assert (unit.metres, unit.name, unit.header, unit.header_metres) == (None, "", "", None)
    assert unit.origin is UnitOrigin.UNKNOWN


def test_a_statement_goes_before_the_header_and_the_header_is_kept_beside_it() -> None:
    unit = drawing_unit(new(insunits=4).header, " cm ")
    assert (unit.metres, unit.name, unit.origin) == (0.01, "cm", UnitOrigin.STATED)
    assert (unit.header, unit.header_metres) == ("mm", 0.001)
    silent = drawing_unit(new(insunits=0).header, "0.641 m")
    assert (silent.metres, silent.header_metres) == (0.641, None)


@pytest.mark.parametrize("code", [0, 2, 4, 21])
def test_the_reader_tells_it_of_a_file(tmp_path: Path, code: int) -> None:
    document = new(insunits=code)
    document.modelspace().add_line((0, 0), (1, 0))
    metres = read_back(document, tmp_path).unit.metres
    assert metres == (pytest.approx(CODES[code]) if code else None)
