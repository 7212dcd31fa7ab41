# SPDX-License-Identifier: MIT
"""What was taken in of a delivery so far: every file is accounted for, with its hash and its state."""

import os
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from itertools import islice
from pathlib import Path, PurePosixPath

from foparq.errors import InputError, ManifestError, UnsafeError
from foparq.model.delivery import Source, SourceStatus
from foparq.model.part import Part
from foparq.names import folded, likeness, nearest
from foparq.profile.schema import Profile
from foparq.read.gis.companions import companions
from foparq.read.guard.paths import MOST_FILES, alike, files_of, fit_to_read, name_of, sha256_of

Progress = Callable[[str], None]

_LONGEST = 300  #: letters of a path that are told
_LIKE = 0.6  #: of two names of files from which one may be a slip of the other
_OUTPUT = frozenset({"audit"})  #: where ``foparq audit`` writes: not part of what was delivered


@dataclass
class Intake:
    """What was taken in so far."""

    profile: Profile
    scale: float | None
    progress: Progress | None
    sources: list[Source] = field(default_factory=list)
    parts: list[Part] = field(default_factory=list)
    crashes: list[str] = field(default_factory=list)
    taken: set[Path] = field(default_factory=set)  #: files accounted for, links resolved

    def tell(self, name: str) -> None:
        """Say what is being read."""
        if self.progress is not None:
            self.progress(name)


def shown_path(named: str) -> str:
    """Path as the manifest names it, with one kind of slash; a name that no file can have is shortened."""
    shown = PurePosixPath(named.replace("\\", "/")).as_posix()
    return shown if len(shown) <= _LONGEST else f"{shown[:_LONGEST]}..."


def take_manifest(intake: Intake, root: Path, name: str) -> None:
    """Take in the manifest itself."""
    path = root / name
    intake.taken.add(path.resolve())
    intake.sources.append(
        Source(
            path=name,
            role="manifest",
            sha256=sha256_of(path),
            bytes=path.stat().st_size,
            status=SourceStatus.READ,
            items=1,
        )
    )


def take_profile(intake: Intake, root: Path) -> None:
    """Take in the files of a profile that does not come with foparq: what decided is hashed like what was delivered."""
    for file in intake.profile.files:
        intake.taken.add(file.path.resolve())
        source = Source(
            path=_seen_from(root, file.path),
            role="profile",
            sha256=file.sha256,
            bytes=file.bytes,
            status=SourceStatus.READ,
            items=1,
        )
        intake.sources.append(source)


def take_unused(intake: Intake, root: Path, path: Path) -> None:
    """Take in a profile that the manifest names and that was not used, because the reviewer states another."""
    if path.resolve() in intake.taken:
        return
    intake.taken.add(path.resolve())
    source = Source(path=_seen_from(root, path), role="other", sha256="", bytes=0, status=SourceStatus.READ)
    try:
        intake.sources.append(identified(source, path, intake.profile.limits.bytes))
    except InputError:
        intake.sources.append(replace(source, status=SourceStatus.UNNAMED))


def _seen_from(root: Path, path: Path) -> str:
    """Path relative to a folder if it lies there by its words, else as it is given."""
    full = Path(os.path.abspath(path))  # noqa: PTH100 - a link is named as it is, not where it leads
    home = Path(os.path.abspath(root))  # noqa: PTH100
    return name_of((full.relative_to(home) if full.is_relative_to(home) else path).as_posix())


def take_once(intake: Intake, path: Path, name: str) -> None:
    """Account for a drawing; named twice it is refused: counted twice, what is missing would look complete."""
    if path.resolve() in intake.taken:
        raise ManifestError("manifest.drawing-twice", value=name)
    intake.taken.add(path.resolve())


def take_companions(intake: Intake, name: str, path: Path, limit: int) -> None:
    """Take in the other files of a Shapefile: what was read with it is hashed with it."""
    if path.suffix.casefold() != ".shp" or not path.is_file():
        return
    folder = name.rpartition("/")[0]
    try:
        beside = companions(path, limit)
    except InputError:
        return  # told of the drawing itself
    for other in beside.values():
        intake.taken.add(other.resolve())
        shown = name_of(f"{folder}/{other.name}" if folder else other.name)
        intake.sources.append(
            Source(
                path=shown, role="other", sha256=sha256_of(other), bytes=other.stat().st_size, status=SourceStatus.READ
            )
        )


def identified(source: Source, path: Path, limit: int) -> Source:
    """The source with its size and hash, or as missing.

    Raises
    ------
    InputError
        If it is no regular file, too large, or may not be read.
    """
    if not path.exists():
        fields: tuple[tuple[str, object], ...] = (("file", source.path),)
        message = "read.missing"
        if (other := alike(path, folded)) is not None:
            named = "/".join(other.parts[-len(PurePosixPath(source.path).parts) :])
            fields, message = (*fields, ("other", name_of(named))), "read.missing-like"
        elif (near := _named_like(path)) is not None:
            folder = PurePosixPath(source.path).parent
            fields, message = (*fields, ("other", name_of((folder / near).as_posix()))), "read.missing-near"
        return replace(source, status=SourceStatus.MISSING, error=message, fields=fields)
    try:
        size = fit_to_read(path, limit)
        return replace(source, sha256=sha256_of(path), bytes=size)
    except PermissionError:
        raise UnsafeError("read.no-permission", file=path.name) from None


def _named_like(path: Path) -> str | None:
    """Name of the file of that kind beside a path that is most like it, if any is."""
    try:
        names = sorted(one.name for one in islice(path.parent.iterdir(), MOST_FILES) if one.is_file())
    except OSError:
        return None
    kind = [name for name in names if folded(PurePosixPath(name).suffix) == folded(path.suffix)]
    stems = {PurePosixPath(name).stem: name for name in kind}
    near = nearest(path.stem, stems)
    return stems[near[0]] if near and likeness(path.stem, near[0]) >= _LIKE else None


def refused(source: Source, name: str, message: str, fields: dict[str, object]) -> Source:
    """The source as refused, under the name that the manifest writes: it tells more than that of the file alone."""
    said = {key: name_of(value) if isinstance(value, str) else value for key, value in fields.items()}
    named = {**said, "file": name}
    return replace(source, status=SourceStatus.REFUSED, error=message, fields=tuple(sorted(named.items())))


def take_unnamed(intake: Intake, root: Path) -> None:
    """Take in what lies in the folder and is not named."""
    named = {source.path for source in intake.sources}
    for count, path in enumerate(files_of(root, _OUTPUT)):
        if count >= MOST_FILES:
            fields = (("file", root.resolve().name), ("limit", MOST_FILES))
            intake.sources.append(
                Source(
                    path=".",
                    role="other",
                    sha256="",
                    bytes=0,
                    status=SourceStatus.REFUSED,
                    error="read.too-many-files",
                    fields=fields,
                )
            )
            return
        name = name_of(path.relative_to(root).as_posix())
        link = path.is_symlink()
        if name in named or (not link and path.resolve() in intake.taken):
            continue
        size = 0 if link or not path.is_file() else path.stat().st_size
        intake.sources.append(Source(path=name, role="other", sha256="", bytes=size, status=SourceStatus.UNNAMED))
