# SPDX-License-Identifier: MIT
"""What ``foparq init`` does: a manifest proposed from the files found. What only a person knows stays open."""

import json
from pathlib import Path, PurePosixPath

import click

from foparq.audit import MANIFEST
from foparq.errors import ManifestError, WriteError
from foparq.profile.load import load_profile
from foparq.read.table.survey import FoundDrawing, FoundTable, Survey, survey_folder
from foparq.report.words import Words, printable

_PROFILE = "et-doc-foparq-a"
_MOST_LAYERS = 40
_CLEARLY = 2.0  #: so many times wider is an axis of the sheet than its depth


def init_work(say: Words, *, folder: Path, force: bool) -> int:
    """Write ``delivery.toml`` into a folder; returns the exit code."""
    if not folder.is_dir():
        raise ManifestError("manifest.no-folder", file=str(folder), example="foparq init fixtures/deliveries/station-a")
    path = folder / MANIFEST
    if path.exists() and not force:
        raise ManifestError("manifest.exists", file=str(path), example=f'foparq init "{folder}" --force')
    found = survey_folder(folder, load_profile(_PROFILE))
    if not found.drawings:
        raise ManifestError("manifest.nothing", file=str(folder), example='foparq init "my-delivery"')
    try:
        path.write_text(manifest_text(found, folder.resolve().name, say), encoding="utf-8")
    except UnicodeEncodeError as error:
        named = error.object[max(0, error.start - 20) : error.end + 20].strip()
        raise ManifestError("manifest.name-not-utf8", file=str(folder), value=named) from None
    except OSError as error:
        why = error.strerror or str(error)
        raise WriteError("write.folder", file=str(folder), value=why, example=f'foparq init "{folder}"') from None
    click.echo(say("cli.init.done", file=str(path), folder=str(folder)))
    return 0


def manifest_text(found: Survey, title: str, say: Words) -> str:
    """Text of a manifest, commented in the language of the user.

    Parameters
    ----------
    title : str
        Proposed title.

    Returns
    -------
    str
        TOML that :func:`foparq.profile.load.load_manifest` takes as it stands.
    """
    lines = [
        *_comment(say("cli.manifest.head")),
        "",
        "[delivery]",
        f"title = {_quoted(title)}",
        f"profile = {_quoted(_PROFILE)}",
        f'# scale = "1:50"  # {say("cli.manifest.scale")}',
        f"language = {_quoted(say.language)}",
    ]
    for n, drawing in enumerate(found.drawings):
        twin = next((other for other in found.drawings[:n] if _same_drawing(drawing, other)), None)
        proposed = _drawing(drawing, say)
        if twin is not None:
            told = _comment(say("cli.manifest.twin", file=drawing.path, other=twin.path))
            proposed = [*told, *(line if line.startswith("#") else f"# {line}" for line in proposed)]
        lines += ["", *proposed]
    for role, example in (("features", ""), ("checkpoints", "3 mm"), ("distances", "3 mm")):
        lines += ["", *_comment(say(f"cli.manifest.{role}")), *_table(role, found.tables.get(role, ()), example, say)]
    if found.others:
        lines += ["", *_comment(say("cli.manifest.others")), *(f"#   {printable(name)}" for name in found.others)]
    return "\n".join(lines) + "\n"


def _drawing(drawing: FoundDrawing, say: Words) -> list[str]:
    unit = drawing.header or "m"
    says = say("cli.manifest.unit-says", unit=drawing.header) if drawing.header else say("cli.manifest.unit-silent")
    x, y, z = drawing.extent
    shown = drawing.layers[:_MOST_LAYERS]
    more = [f"# ... ({len(drawing.layers)})"] if len(drawing.layers) > _MOST_LAYERS else []
    return [
        "[[drawing]]",
        f"path = {_quoted(drawing.path)}",
        f"# unit = {_quoted(unit)}  # {says}",
        f"{_plane(drawing.extent)}  # {say('cli.manifest.plane', x=x, y=y, z=z)}",
        f'# facade = "N"  # {say("cli.manifest.facade")}',
        *_comment(say("cli.manifest.classes")),
        '# classes = { "ESQUADRIA*" = "window", "PORTA*" = "door" }',
        *_comment(say("cli.manifest.areas")),
        '# areas = ["REVESTIMENTO"]',
        f"# {say('cli.manifest.layers')}",
        *(f"#   {printable(layer)}" for layer in shown),
        *more,
    ]


def _same_drawing(one: FoundDrawing, two: FoundDrawing) -> bool:
    """Whether two files are one drawing in two formats: named alike."""
    return PurePosixPath(one.path).with_suffix("") == PurePosixPath(two.path).with_suffix("")


def _plane(extent: tuple[float, float, float]) -> str:
    """Line that states the two widest axes: a facade drawn in space stands upright. Left open where two are alike."""
    order = sorted(range(3), key=lambda axis: (extent[axis], -axis))
    line = f'plane = "{("yz", "xz", "xy")[order[0]]}"'
    return line if extent[order[1]] > _CLEARLY * extent[order[0]] else f"# {line}"


def _table(role: str, found: tuple[FoundTable, ...], survey_sd: str, say: Words) -> list[str]:
    if not found:
        body = [f"# [{role}]", f'# path = "{role}.csv"']
        return body + ([f'# survey_sd = "{survey_sd}"'] if survey_sd else [])
    first, *others = found
    lines = [f"[{role}]", f"path = {_quoted(first.path)}"]
    if first.sheet is not None:
        lines.append(f"sheet = {_quoted(first.sheet)}")
    if survey_sd:
        lines.append(f'# survey_sd = "{survey_sd}"  # {say("cli.manifest.survey-sd")}')
    names = [f"{other.path} ({other.sheet})" if other.sheet is not None else other.path for other in others]
    return lines + [f"# {say('cli.manifest.also')}: {printable(name)}" for name in names]


def _comment(text: str) -> list[str]:
    return [f"# {line}".rstrip() for line in text.split("\n")]


def _quoted(text: str) -> str:
    """TOML basic string, letters that are not printable as escapes; surrogates have none."""
    string = json.dumps(text, ensure_ascii=False)
    return "".join(c if c.isprintable() or "\ud800" <= c <= "\udfff" else f"\\U{ord(c):08x}" for c in string)
