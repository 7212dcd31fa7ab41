# SPDX-License-Identifier: MIT
"""Everything the reports are written from: one finished audit."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from foparq.evaluate.quality import QualityReport
from foparq.findings.outcome import Outcome
from foparq.findings.table import Findings
from foparq.model.delivery import Delivery


@dataclass(frozen=True, slots=True, kw_only=True)
class AuditRecord:
    """One finished audit. Reports are written from it and compute nothing."""

    delivery: Delivery
    quality: QualityReport
    outcomes: tuple[Outcome, ...]
    findings: Findings
    profile: str  #: name
    profile_title: str
    profile_sha256: str
    product_class: str  #: ``"A"`` or ``"B"``
    scale: float | None  #: denominator k of 1:k
    language: str  #: ``"pt-BR"`` or ``"en"``
    loose: bool = False  #: ``foparq check``: files without a manifest; there is no verdict on a delivery
    started: str = ""  #: ISO 8601, UTC
    versions: dict[str, str] = field(default_factory=dict)  #: foparq, GEOS, GDAL, ezdxf ...
    written: int = 100_000  #: findings written in full per rule; counting is never capped
    crashed: tuple[str, ...] = ()  #: files of reports that foparq failed to make
    norms: tuple[str, ...] = ()  #: what the profile cites, with dates
    profile_titles: Mapping[str, str] = field(default_factory=dict)  #: by language
    profile_shipped: bool = True  #: false: a profile of somebody's own, in files that are among the inputs
    profile_changes: tuple[str, ...] = ()  #: what was set otherwise for this run
    compared: str = ""  #: shipped profile that one of somebody's own was compared with
