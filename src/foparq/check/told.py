# SPDX-License-Identifier: MIT
"""What a rule found, as rows of the table of findings."""

import math

import numpy as np

from foparq.check.calls import Call
from foparq.check.subject import Subject
from foparq.columns import Texts
from foparq.findings.hits import NOBODY, Hits
from foparq.findings.table import Findings, Severity, finding_keys
from foparq.model.inputs import Named, Names

_OF_FILE = {"m": "u", "m2": "u2"}  #: what lengths and areas are in where the unit of the file is unknown
_KEY_GRID = 0.001  #: metres: above the noise of coordinates, below the distance of two findings


def findings_of(call: Call, subject: Subject, inputs: tuple[Named, ...], found: Hits) -> Findings:
    """Findings of k hits.

    Parameters
    ----------
    inputs : tuple of Named
        What the rule looked at: hits are rows of the first, the others rows of the last.
    found : Hits, k rows
    """
    n, rule, first, last = len(found), call.rule, inputs[0], inputs[-1]
    item, layer = first.item[found.row], first.layer[found.row]
    other, other_layer = (_of_others(column, found) for column in (last.item, last.layer))
    places = subject.places(found, first)
    limit = call.tolerances[rule.limit] if rule.limit else math.nan
    # A rule in preview is reported and cannot reject, whatever the profile says.
    severity = Severity.NOTE.value if rule.preview else call.spec.severity.value
    nobody = _same("", n)
    names = (nobody, nobody) if subject.named_by_place else (item, other)
    unit = rule.size_unit if subject.measured else _OF_FILE.get(rule.size_unit, rule.size_unit)
    return Findings(
        key=finding_keys(rule.code, layer, *names, places.point * subject.metres, _KEY_GRID),
        rule=_same(rule.code, n), name=_same(rule.name, n), severity=_same(severity, n),
        source=_same(subject.part.path, n), layer=layer, item=item, handle=first.handle[found.row],
        inserts=first.inserts[found.row], other=other, other_layer=other_layer, where=places.where, sheet=places.sheet,
        place=places.point, size=found.size, unit=_same(unit, n), limit=np.full(n, limit),
        told=first.told[found.row], waived=np.zeros(n, dtype=bool),
    )  # fmt: skip


def _of_others(column: Names, found: Hits) -> Texts:
    named = found.other != NOBODY
    texts: Texts = np.full(len(found), "", dtype=object)
    texts[named] = column[found.other[named]]
    return texts


def _same(value: str, n: int) -> Texts:
    return np.full(n, value, dtype=object)
