# SPDX-License-Identifier: MIT
"""Text of the manifest that ``foparq init`` proposes. What only a person knows stays a comment, with its meaning."""

import json
from collections.abc import Sequence
from dataclasses import replace

from foparq.cli.init_names import aids_like, class_like, facade_like
from foparq.profile.examples import EXAMPLES
from foparq.read.cloud.found import FoundCloud
from foparq.read.table.revisions import revision_of
from foparq.read.table.survey import FoundDrawing, FoundMesh, FoundTable, Other, Survey
from foparq.report.words import Words, printable

PROFILE = "et-doc-foparq-a"
_MOST_LAYERS = 40
_CLEARLY = 2.0  #: so many times wider is an axis of the sheet than its depth
_CONTRACT = ("process", "contract", "contractor", "responsible", "revision", "date")


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
        f"profile = {_quoted(PROFILE)}",
        f'# scale = "1:50"  # {say("cli.manifest.scale")}',
        f"language = {_quoted(say.language)}",
    ]
    lines += ["", *_comment(say("cli.manifest.contract")), "# [contract]", *_contract(say)]
    for drawing in found.drawings:
        proposed = _drawing(drawing, found, say)
        if asked := rival(drawing, found.drawings, say):
            commented = (line if line.startswith("#") else f"# {line}" for line in proposed)
            proposed = [*_comment(asked), *commented]
        lines += ["", *proposed]
    for mesh in found.meshes:
        lines += ["", *_mesh(mesh, say)]
    for cloud in found.clouds:
        lines += ["", *_reference(cloud, found.meshes, say)]
    for role in ("features", "checkpoints", "distances"):
        lines += ["", *_comment(say(f"cli.manifest.{role}")), *_table(role, found.tables.get(role, ()), say)]
    if found.others:
        lines += ["", *_comment(say("cli.manifest.others")), *(f"#   {other_line(one, say)}" for one in found.others)]
    return "\n".join(lines) + "\n"


def _contract(say: Words) -> list[str]:
    named = {key: f"{key} = {_quoted(say(f'cli.manifest.{key}-example'))}" for key in ("contractor", "responsible")}
    return [f"# {named.get(key, EXAMPLES[key])}" for key in _CONTRACT]


def rival(drawing: FoundDrawing, drawings: Sequence[FoundDrawing], say: Words) -> str:
    """Question about a drawing that seems to be another revision or format of a proposed one; ``""`` if none is."""
    own = revision_of(drawing.path)
    alike = [other for other in drawings if revision_of(other.path).base == own.base]
    chosen = max(alike, key=lambda other: revision_of(other.path).rank)  # the first of equals
    if chosen is drawing:
        return ""
    kind = "twin" if revision_of(chosen.path).rank == own.rank else "revision"
    return say(f"cli.manifest.{kind}", file=drawing.path, other=chosen.path)


def other_line(other: Other, say: Words) -> str:
    """A file that was taken for nothing, and why."""
    name = printable(other.path)
    if other.aside:
        return f"{name}: {say('cli.manifest.aside')}"
    if not other.message:
        return name
    why = say(f"errors.{other.message}", **dict(other.fields))
    return f"{name}: {say(f'cli.manifest.not-{other.role}')} {why}" if other.role else why


def _drawing(drawing: FoundDrawing, found: Survey, say: Words) -> list[str]:
    unit = drawing.header or "m"
    says = say("cli.manifest.unit-says", unit=drawing.header) if drawing.header else say("cli.manifest.unit-silent")
    x, y, z = drawing.extent
    return [
        "[[drawing]]",
        f"path = {_quoted(drawing.path)}",
        f"# unit = {_quoted(unit)}  # {says}",
        f"{_plane(drawing.extent)}  # {say('cli.manifest.plane', x=x, y=y, z=z)}",
        *_facade(drawing, found, say),
        *_classes(drawing, found, say),
        *_comment(say("cli.manifest.areas")),
        '# areas = ["REVESTIMENTO"]',
        *_ignored(drawing, found, say),
        *_layers(drawing, found, say),
    ]


def _mesh(mesh: FoundMesh, say: Words) -> list[str]:
    unit = mesh.header or "m"
    says = say("cli.manifest.unit-says", unit=mesh.header) if mesh.header else say("cli.manifest.mesh-unit")
    x, y, z = mesh.extent
    return [
        "[[mesh]]",
        f"path = {_quoted(mesh.path)}",
        *_comment(say("cli.manifest.mesh", faces=mesh.faces, x=x, y=y, z=z)),
        f"# unit = {_quoted(unit)}  # {says}",
        f"# closed = false  # {say('cli.manifest.closed')}",
    ]


def _reference(cloud: FoundCloud, meshes: Sequence[FoundMesh], say: Words) -> list[str]:
    x, y, z = cloud.extent
    mesh = meshes[0].path if meshes else "busto.ply"
    # Without a mesh nothing can be compared with it.
    mark = "" if meshes else "# "
    return [
        *_comment(say("cli.manifest.references", points=cloud.points, x=x, y=y, z=z)),
        f"{mark}[[reference]]",
        f"{mark}path = {_quoted(cloud.path)}",
        f'# unit = "m"  # {say("cli.manifest.mesh-unit")}',
        f'# survey_sd = "3 mm"  # {say("cli.manifest.reference-sd")}',
        f"# mesh = {_quoted(mesh)}  # {say('cli.manifest.reference-mesh')}",
    ]


def _facade(drawing: FoundDrawing, found: Survey, say: Words) -> list[str]:
    if not found.facades:
        return [f'# facade = "N"  # {say("cli.manifest.facade")}']
    like = facade_like(drawing.path, found.facades) or found.facades[0]
    listed = say("cli.manifest.facade-listed", facades=[_quoted(name) for name in found.facades])
    return [f"# facade = {_quoted(like)}  # {listed}"]


def _classes(drawing: FoundDrawing, found: Survey, say: Words) -> list[str]:
    if not found.classes:
        return [*_comment(say("cli.manifest.classes")), '# classes = { "ESQUADRIA*" = "window", "PORTA*" = "door" }']
    bound = {layer: like for layer in drawing.layers if (like := class_like(layer, found.classes))}
    shown = bound or {"CAMADA*": found.classes[0]}
    pairs = ", ".join(f"{_quoted(layer)} = {_quoted(name)}" for layer, name in shown.items())
    names = [_quoted(name) for name in found.classes]
    return [*_comment(say("cli.manifest.classes-listed", classes=names)), f"# classes = {{ {pairs} }}"]


def _ignored(drawing: FoundDrawing, found: Survey, say: Words) -> list[str]:
    aids = [layer for layer in aids_like(drawing.layers) if not class_like(layer, found.classes)][:_MOST_LAYERS]
    names = ", ".join(_quoted(layer) for layer in aids)
    return [*_comment(say("cli.manifest.ignore-layers")), f"# ignore_layers = [{names}]"] if aids else []


def _layers(drawing: FoundDrawing, found: Survey, say: Words) -> list[str]:
    shown = drawing.layers[:_MOST_LAYERS]
    more = len(drawing.layers) - len(shown)
    rest = [f"# {say('cli.manifest.more-layers', count=more)}"] if more else []
    if not found.classes:
        return [f"# {say('cli.manifest.layers')}", *(f"#   {printable(layer)}" for layer in shown), *rest]
    width = max((len(printable(layer)) for layer in shown), default=0)
    rows = [f"#   {printable(layer):<{width}}  {class_like(layer, found.classes) or '–'}" for layer in shown]
    return [f"# {say('cli.manifest.layers-classes')}", *map(printable, rows), *rest]


def _plane(extent: tuple[float, float, float]) -> str:
    """Line that states the two widest axes: a facade drawn in space stands upright. Left open where two are alike."""
    order = sorted(range(3), key=lambda axis: (extent[axis], -axis))
    line = f'plane = "{("yz", "xz", "xy")[order[0]]}"'
    return line if extent[order[1]] > _CLEARLY * extent[order[0]] else f"# {line}"


def _table(role: str, found: tuple[FoundTable, ...], say: Words) -> list[str]:
    asks = role != "features"
    sd = [*_comment(say(f"cli.manifest.survey-sd-{role}")), '# survey_sd = "3 mm"'] if asks else []
    if not found:
        return [f"# [{role}]", f'# path = "{role}.csv"', *sd]
    first, *others = found
    lines = [f"[{role}]", f"path = {_quoted(first.path)}"]
    if first.sheet is not None:
        lines.append(f"sheet = {_quoted(first.sheet)}")
    return lines + sd + [f"# {also_line(first, other, say)}" for other in others]


def also_line(first: FoundTable, other: FoundTable, say: Words) -> str:
    """Another table of that role: a revision of the one that is proposed, or one that looks like it."""
    named = printable(f"{other.path} ({other.sheet})" if other.sheet is not None else other.path)
    revised = replace(other, path=first.path) == first and revision_of(other.path).base == revision_of(first.path).base
    if revised and other.path != first.path:
        return say("cli.manifest.table-revision", file=named, other=first.path)
    return f"{say('cli.manifest.also')}: {named}"


def _comment(text: str) -> list[str]:
    return [f"# {line}".rstrip() for line in text.split("\n")]


def _quoted(text: str) -> str:
    """TOML basic string, letters that are not printable as escapes; surrogates have none."""
    string = json.dumps(text, ensure_ascii=False)
    return "".join(c if c.isprintable() or "\ud800" <= c <= "\udfff" else f"\\U{ord(c):08x}" for c in string)
