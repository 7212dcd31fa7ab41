# SPDX-License-Identifier: MIT
"""One delivery, audited: read, check, evaluate. The whole flow on a page."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from functools import partial
from importlib.metadata import version
from pathlib import Path

import numpy as np
import shapely

from foparq import __version__
from foparq.bounded import in_child, once
from foparq.check.bounds import Broken
from foparq.check.drawn.symbols import with_symbols
from foparq.check.drawn.witnesses import with_witnesses
from foparq.check.run import check_part
from foparq.check.tables.ground import Nearness
from foparq.check.tables.listed import listed_in
from foparq.check.tables.ties import prepare, tie_evidence
from foparq.check.validate import validate_checks
from foparq.errors import ManifestError
from foparq.evaluate.decisions import wrong_decision
from foparq.evaluate.evaluate import evaluate
from foparq.evaluate.evidence import Evidence
from foparq.findings.because import Because
from foparq.findings.clouds import CloudDistances
from foparq.findings.counts import FeatureCounts
from foparq.findings.table import Severity, join_findings
from foparq.findings.ties import Ties
from foparq.model.delivery import Delivery
from foparq.profile.elements import SurfaceDistanceSpec
from foparq.profile.load import load_manifest
from foparq.profile.schema import Profile
from foparq.profile.terms import Reviewer, Terms, terms_of
from foparq.read.delivery import read_delivery, read_loose
from foparq.read.versions import reader_versions
from foparq.report.files import Written, writable, write_reports
from foparq.report.record import AuditRecord

MANIFEST = "delivery.toml"
OUT = "audit"  #: folder of the reports, beside the manifest
_NOTHING = Reviewer()  #: the delivery's own words hold

Progress = Callable[[str], None]
COMPILING = "compiling"  #: a step: kernels for meshes, once on a machine


@dataclass(frozen=True, slots=True, kw_only=True)
class Audit:
    """A finished audit and the log of what went wrong on our side."""

    record: AuditRecord
    log: tuple[str, ...]


def find_manifest(place: Path) -> Path:
    """Manifest of a delivery given as folder or manifest.

    Raises
    ------
    ManifestError
        If there is none.
    """
    if place.is_dir():
        place = place / MANIFEST
        if not place.is_file():
            raise ManifestError("manifest.none", file=str(place.parent), example=f'foparq init "{place.parent}"')
    elif not place.is_file():
        raise ManifestError("manifest.missing", file=str(place), example="foparq audit fixtures/deliveries/station-a")
    elif place.suffix.lower() != ".toml":
        raise ManifestError("manifest.not-toml", file=str(place), example=f'foparq check "{place}"')
    return place


def audit(
    place: Path, *, reviewer: Reviewer = _NOTHING, language: str | None = None, otherwise: str = "en",
    progress: Progress | None = None,
) -> Audit:  # fmt: skip
    """Audit one delivery.

    Parameters
    ----------
    place : Path
        The delivery's folder, or its manifest.
    reviewer : Reviewer
        Statements that go before the delivery's.
    language : str, optional
        Language of the reports; the manifest's if left out.
    otherwise : str
        Language if the manifest names none.
    progress : callable, optional
        Told what is being done.

    Raises
    ------
    UsageError
        If the manifest or the profile is wrong. Faults of the delivery never raise.
    """
    path = find_manifest(place)
    manifest = load_manifest(path)
    terms = terms_of(manifest, path, reviewer)
    validate_checks(terms.profile)
    delivery, log = read_delivery(
        path.parent, manifest, path.name, profile=terms.profile, scale=terms.scale, unused=terms.unused,
        progress=progress,
    )  # fmt: skip
    spoken = language or manifest.delivery.language or otherwise
    return _judged(delivery, log, terms, spoken, progress, loose=False)


def audit_to(
    place: Path, out: Path | None = None, *, reviewer: Reviewer = _NOTHING, language: str | None = None,
    otherwise: str = "en", progress: Progress | None = None,
) -> Written:  # fmt: skip
    """Audit one delivery and write its reports into a folder.

    Parameters
    ----------
    place : Path
        The delivery's folder, or its manifest.
    out : Path, optional
        Where the reports go; ``audit/`` beside the manifest if left out.
    reviewer, language, otherwise, progress
        As in :func:`audit`.

    Returns
    -------
    Written
        What :func:`foparq.evaluate.exit_of.exit_of` makes an exit code of is its ``record.quality``.

    Raises
    ------
    UsageError
        If the manifest or the profile is wrong.
    WriteError
        If the reports cannot be written, told before any work is done where it can be known.
    """
    folder = out or find_manifest(place).parent / OUT
    writable(folder)
    done = audit(place, reviewer=reviewer, language=language, otherwise=otherwise, progress=progress)
    return write_reports(done.record, done.log, folder, progress)


def check_files(
    paths: Sequence[Path], *, profile: Profile, scale: float | None, unit: str | None, plane: str | None,
    areas: tuple[str, ...], bind: tuple[tuple[str, ...], ...] = (), ignore_layers: tuple[str, ...] = (), language: str,
    closed: bool | None = None, rims: int | None = None, progress: Progress | None = None,
) -> Audit:  # fmt: skip
    """Check loose drawings and meshes without a manifest; there is no verdict on a delivery.

    Parameters
    ----------
    scale : float or None
        Denominator k of the drawing scale 1:k.
    unit : str or None
        What one drawing unit is; ``None``: as the file says.
    plane : str or None
        ``"xy"``, ``"xz"``, ``"yz"`` or ``"fit"``.
    areas, bind, ignore_layers, closed, rims
        As for :func:`foparq.read.delivery.read_loose`.
    """
    validate_checks(profile)
    delivery, log = read_loose(
        paths, profile=profile, scale=scale, unit=unit, plane=plane, areas=areas, bind=bind,
        ignore_layers=ignore_layers, closed=closed, rims=rims, progress=progress,
    )  # fmt: skip
    return _judged(delivery, log, Terms(profile=profile, scale=scale), language, progress, loose=True)


def _judged(
    delivery: Delivery, log: Sequence[str], terms: Terms, language: str, progress: Progress | None, *, loose: bool
) -> Audit:
    started = datetime.now(UTC).isoformat(timespec="seconds")
    if delivery.meshes and progress is not None:
        from foparq.mesh.warm import cold  # noqa: PLC0415 - a drawing never loads the kernels of meshes

        if cold():
            progress(COMPILING)
    profile, scale = terms.profile, terms.scale
    if not loose:
        prepare(delivery)
    ties, untied = _tied(delivery, profile, scale) if not loose else (None, None)
    if not loose:
        delivery = with_witnesses(delivery, ties)
    delivery, unsure = with_symbols(delivery, profile, scale, in_child)
    checked = [check_part(part, profile, scale, progress, in_child) for part in delivery.parts]
    outcomes = tuple(outcome for one in checked for outcome in one.outcomes)
    findings = join_findings([one.findings for one in checked])
    gap = profile.completeness.gap.si(scale) if profile.completeness and not loose else None
    near = profile.evidence.search.si(scale) if profile.evidence and gap is not None else gap or 0.0
    counts, broken = (None, None) if gap is None else _counted(delivery, gap, near, profile)
    clouds, uncompared = _against_clouds(delivery, profile, scale) if not loose else ((), None)
    traces = (
        *(*log, *unsure, *(trace for one in checked for trace in one.log)),
        *(one.trace for one in (untied, broken, uncompared) if one and one.trace),
    )
    ended = [one.because for one in (untied, broken, uncompared) if one]
    evidence = Evidence(
        delivery=delivery, outcomes=outcomes, counts=counts, scale=scale,
        uncounted=broken.because if broken else Because.RAN,
        crashed=bool(log or unsure) or Because.CRASHED in ended,
        ties=ties, clouds=clouds, uncompared=uncompared.because if uncompared else Because.RAN,
        faults=int(np.count_nonzero(findings.severity != Severity.NOTE)),
    )  # fmt: skip
    if not loose and (wrong := wrong_decision(profile, evidence)) is not None:
        raise ManifestError(f"decision.{wrong.kind}", file=_manifest_of(delivery), **wrong.fields)
    evaluated = evaluate(profile, evidence, terms=terms, loose=loose)
    record = AuditRecord(
        delivery=delivery,
        quality=evaluated.quality,
        outcomes=outcomes,
        findings=findings,
        profile=profile.name,
        profile_title=profile.titled(language),
        profile_titles=profile.title,
        profile_sha256=profile.sha256,
        profile_shipped=profile.shipped,
        profile_changes=profile.changes,
        compared=terms.compared,
        product_class=profile.product_class,
        scale=scale,
        language=language,
        loose=loose,
        started=started,
        versions=versions(),
        norms=profile.norms,
        written=profile.limits.written,
    )
    return Audit(record=record, log=(*traces, *evaluated.log))


def _manifest_of(delivery: Delivery) -> str:
    return next((source.path for source in delivery.sources if source.role == "manifest"), MANIFEST)


def _tied(delivery: Delivery, profile: Profile, scale: float | None) -> tuple[Ties | None, Broken | None]:
    """What of the tables belongs to the drawings, or why the search broke off."""
    if profile.evidence is None:
        return None, None
    near = Nearness(**{name: getattr(profile.evidence, name).si(scale) for name in Nearness._fields})
    ties, broken = once("tying evidence", tie_evidence, (delivery, near), delivery, profile)
    return (Ties(broken=broken.because) if broken else ties), broken


def _counted(
    delivery: Delivery, gap: float, near: float, profile: Profile
) -> tuple[FeatureCounts | None, Broken | None]:
    """Delivered features, or why their count broke off."""
    return once("counting features", partial(listed_in, gap=gap, near=near), (delivery,), delivery, profile)


def _against_clouds(
    delivery: Delivery, profile: Profile, scale: float | None
) -> tuple[tuple[CloudDistances, ...], Broken | None]:
    """Distances of the references from the meshes, or why their search broke off."""
    if profile.evidence is None or not (delivery.references and delivery.meshes):
        return (), None
    from foparq.check.surfaces.clouds import compare_clouds  # noqa: PLC0415 - a drawing never loads it

    specs = [spec for spec in profile.elements if isinstance(spec, SurfaceDistanceSpec) and spec.beyond is not None]
    beyond = specs[0].beyond.si(scale) if specs and specs[0].beyond is not None else None
    search = profile.evidence.search.si(scale)
    compare = partial(compare_clouds, search=search, beyond=beyond)
    points = sum(len(cloud.points) for cloud in delivery.references)
    found, broken = once("comparing references", compare, (delivery,), delivery, profile, more=points)
    return found or (), broken


def versions() -> dict[str, str]:
    """Versions of everything that decides a result."""
    return {
        "foparq": __version__,
        "GEOS": shapely.geos_version_string,
        **reader_versions(),
        "shapely": shapely.__version__,
        "numpy": np.__version__,
        "scipy": version("scipy"),
    }
