# SPDX-License-Identifier: MIT
"""Under which specification and at which scale a delivery is audited, and who says so.

A manifest and a profile in the delivery's folder are the producer's words. What the reviewer states goes before them.
"""

import os
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from foparq.errors import ManifestError, ProfileError, UsageError
from foparq.profile.find import find_profile, shipped_profiles
from foparq.profile.load import load_profile
from foparq.profile.looser import Looser, looser
from foparq.profile.manifest import Manifest
from foparq.profile.schema import Profile
from foparq.profile.toml_text import read_toml
from foparq.units import parse_scale

_SHOWN = 80  #: letters of a name in the delivery that are told


@dataclass(frozen=True, slots=True, kw_only=True)
class Reviewer:
    """What the reviewer states on the command line."""

    profile: str | None = None  #: a shipped name, or a path that may lead anywhere
    scale: str | None = None  #: ``"1:50"``


@dataclass(frozen=True, slots=True, kw_only=True)
class Replaced:
    """A statement of the delivery that one of the reviewer goes before."""

    what: Literal["profile", "scale"]
    reviewer: str
    delivery: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Terms:
    """What a run is made under."""

    profile: Profile
    scale: float | None  #: denominator k of 1:k
    compared: str = ""  #: name of the shipped profile that one of one's own is compared with
    looser: tuple[Looser, ...] = ()  #: where that profile is looser
    replaced: tuple[Replaced, ...] = ()
    unused: Path | None = None  #: profile of the delivery's own, in its folder, that the reviewer's goes before


def terms_of(manifest: Manifest, path: Path, reviewer: Reviewer) -> Terms:
    """Terms of an audit.

    Parameters
    ----------
    manifest : Manifest
    path : Path
        Its file. A profile that it names is shipped, or lies in the folder of that file, and so does what it extends.
    reviewer : Reviewer

    Raises
    ------
    UsageError
        If a profile cannot be used, nobody states a scale, or one and the same side states two.
    """
    root, named = path.parent, manifest.delivery.profile
    used = load_profile(named, root, root) if reviewer.profile is None else _reviewers(reviewer.profile, root)
    replaced, unused = [], None
    if reviewer.profile is not None and "profile" in manifest.delivery.model_fields_set:
        delivered = _delivered(named, root)
        if delivered is None or delivered.sha256 != used.sha256:
            replaced.append(Replaced(what="profile", reviewer=used.name, delivery=named[:_SHOWN]))
            unused = _own_file(named, root)
    scale, other = _scales(manifest, path, used, reviewer)
    if other is not None and parse_scale(other) != scale:
        replaced.append(Replaced(what="scale", reviewer=f"1:{scale:g}", delivery=other))
    compared, points = ("", ()) if used.shipped else _comparison(used, scale)
    return Terms(profile=used, scale=scale, compared=compared, looser=points, replaced=tuple(replaced), unused=unused)


def _scales(manifest: Manifest, path: Path, used: Profile, reviewer: Reviewer) -> tuple[float, str | None]:
    """Scale that holds, and what the delivery says where the reviewer states one."""
    delivery = manifest.delivery.scale
    theirs, ours = (used.scale, None) if reviewer.profile is None else (None, used.scale)
    if reviewer.scale and ours and parse_scale(reviewer.scale) != parse_scale(ours):
        raise UsageError("usage.scale-differs", value=reviewer.scale, other=ours, file=used.path)
    if stated := reviewer.scale or ours:
        return parse_scale(stated), delivery or theirs
    if delivery and theirs and parse_scale(delivery) != parse_scale(theirs):
        raise ManifestError("manifest.scale-differs", file=str(path), value=delivery, other=theirs)
    if (found := delivery or theirs) is None:
        line = read_toml(path, ManifestError).line(("delivery",))
        raise ManifestError("manifest.no-scale", file=str(path), line=line, key="scale", example='scale = "1:50"')
    return parse_scale(found), None


def _comparison(profile: Profile, scale: float) -> tuple[str, tuple[Looser, ...]]:
    """Shipped profile that one of one's own is compared with, and where that is looser.

    The one that it extends, or the first shipped one of its class of product: if these are two, the one that shows
    more. A file of one's own is no measure for another.
    """
    shipped = {name: load_profile(name) for name in shipped_profiles()}
    of_class = next((name for name, one in shipped.items() if one.product_class == profile.product_class), "")
    names = [name for name in (profile.extends, of_class) if name in shipped]
    return max(((name, looser(profile, shipped[name], scale)) for name in names), key=lambda one: len(one[1]))


def _reviewers(name: str, root: Path) -> Profile:
    """Profile that the reviewer names. One in the delivery's folder is the producer's, and reaches no farther."""
    full, home = Path(os.path.realpath(name)), root.resolve()  # unlike resolve, it takes a ring of links
    if name.endswith(".toml") and full.is_relative_to(home):
        return load_profile(full.relative_to(home).as_posix(), root, root)
    return load_profile(name)


def _delivered(name: str, root: Path) -> Profile | None:
    """Profile that the delivery names; ``None`` if it cannot be used, which then does not matter."""
    try:
        return load_profile(name, root, root)
    except ProfileError:
        return None


def _own_file(name: str, root: Path) -> Path | None:
    try:
        return find_profile(name, root, root) if name.endswith(".toml") else None
    except ProfileError:
        return None
