# SPDX-License-Identifier: MIT
"""What ``foparq check`` does."""

from collections.abc import Sequence
from pathlib import Path

import click

from foparq.audit import check_files
from foparq.check.catalogue import cards, find_card
from foparq.check.registry import required_by
from foparq.cli.common import progress_on_stderr
from foparq.cli.show import show
from foparq.errors import UsageError
from foparq.evaluate.exit_of import exit_of
from foparq.profile.adjust import choose, with_settings
from foparq.profile.load import load_profile
from foparq.profile.schema import Profile
from foparq.read.guard.sniff import holds_mesh
from foparq.report.files import Written, writable, write_reports
from foparq.report.harmless import log_text
from foparq.report.words import Words
from foparq.units import parse_length_unit, parse_scale


def check_work(
    say: Words, *, files: tuple[Path, ...], profile: str, scale: str | None, unit: str | None, plane: str | None,
    areas: tuple[str, ...], bind: tuple[str, ...], ignore_layers: tuple[str, ...], select: tuple[str, ...],
    ignore: tuple[str, ...], settings: tuple[str, ...], closed: bool | None,
    rims: int | None, out: Path | None, form: str,
) -> int:  # fmt: skip
    """Check loose drawings, tell what was found; returns the exit code."""
    chosen = _profile(profile, select, ignore, settings)
    if all(spec.helper for spec in chosen.checks):
        raise UsageError("usage.no-rules", example="--select TOP")
    stated = scale or chosen.scale
    if stated is None and not all(map(holds_mesh, files)):
        raise UsageError("usage.scale", example="--scale 1:50")
    if closed and rims:
        raise UsageError("usage.closed-rims", value=f"--closed --rims {rims}", example=f"--rims {rims}")
    if unit is not None:
        parse_length_unit(unit)
    if out is not None:
        writable(out)
    with progress_on_stderr(say) as progress:
        done = check_files(
            files, profile=chosen, scale=parse_scale(stated) if stated else None, unit=unit, plane=plane, areas=areas,
            bind=tuple(_patterns(one) for one in bind),
            ignore_layers=tuple(pattern for one in ignore_layers for pattern in _patterns(one)),
            closed=closed, rims=rims, language=say.language, progress=progress,
        )  # fmt: skip
        written = Written(record=done.record, paths=(), log=done.log)
        if out is not None:
            written = write_reports(done.record, done.log, out, progress)
    show(written.record, form, say, written.paths)
    if out is None and written.log:
        click.echo(log_text(written.log), err=True)
    return int(exit_of(written.record.quality))


def _patterns(text: str) -> tuple[str, ...]:
    """Layer patterns that commas part."""
    return tuple(part.strip() for part in text.split(",") if part.strip())


def _profile(name: str, select: Sequence[str], ignore: Sequence[str], settings: Sequence[str]) -> Profile:
    profile = load_profile(name, Path())
    if select or ignore:
        wanted = _names(select) if select else {card.name for card in cards()}
        chosen = sorted(wanted - _names(ignore))
        profile = choose(profile, chosen, required_by(chosen))
    changes = [
        f"{option} {value}"
        for option, values in (("--select", select), ("--ignore", ignore), ("--set", settings))
        for value in values
    ]
    profile = with_settings(profile, settings)
    return profile.model_copy(update={"changes": tuple(changes)}) if changes else profile


def _names(texts: Sequence[str]) -> set[str]:
    """Rule names of codes, names and prefixes such as ``TOP``; several may be joined by commas."""
    names: set[str] = set()
    for text in (part.strip() for given in texts for part in given.split(",") if part.strip()):
        family = {card.name for card in cards() if card.code.startswith(text.upper())}
        names |= family or {find_card(text).name}
    return names
