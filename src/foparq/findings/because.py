# SPDX-License-Identifier: MIT
"""Why a rule did not look at something."""

from enum import StrEnum


class Because(StrEnum):
    """Why a rule did not run; its sentence is ``report.because.VALUE``.

    Whoever reads a reason asks :attr:`opens`. A new member leaves the question open until it is listed as settled.
    """

    RAN = ""  #: it did
    NOTHING = "nothing-to-check"  #: there is nothing of the kind: no fault can hide there
    ALL_ASIDE = "all-set-aside"  #: nothing is left that can be judged
    UNIT_UNKNOWN = "unit-unknown"
    UNIT_ANGLE = "unit-angle"  #: coordinates are degrees: no length
    CRS_UNFIT = "crs-unfit"  #: coordinates that the reference system cannot have
    UNIT_DOUBTFUL = "unit-doubtful"
    UNIT_CONTRADICTED = "unit-contradicted"  #: stated, and two witnesses say another
    PLANE_DOUBTFUL = "plane-doubtful"
    PLANE_CONTRADICTED = "plane-contradicted"  #: stated, and another shows what the drawing is
    REQUIRED_UNBOUND = "required-unbound"  #: a required rule is no part of the run, or not on these layers
    REQUIRED_NOT_RUN = "required-not-run"
    REQUIRED_CRASHED = "required-crashed"
    LIMIT = "limit"  #: time or memory ran out
    CRASHED = "crashed"  #: our fault, never the delivery's

    @property
    def opens(self) -> bool:
        """Whether faults may hide behind it: the question stays open."""
        return self not in _SETTLED


_SETTLED = frozenset({Because.RAN, Because.NOTHING})
