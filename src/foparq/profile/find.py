# SPDX-License-Identifier: MIT
"""Where a profile lies: among those that come with foparq, or in a file of one's own."""

import contextlib
from collections.abc import Mapping
from pathlib import Path, PurePosixPath, PureWindowsPath

from foparq.errors import ProfileError
from foparq.names import nearest
from foparq.profile.letters import odd_letters, shown_letters
from foparq.resources import shipped

_SHOWN = 80  #: letters of a wrong name that a message repeats
_EXAMPLE = "et-doc-foparq-a"


def shipped_profiles() -> list[str]:
    """Names of the profiles that travel with foparq."""
    return sorted(path.stem for path in _folder().glob("*.toml"))


def is_shipped(path: Path) -> bool:
    """Whether a file is one of the profiles that travel with foparq."""
    return path.resolve().parent == _folder().resolve() and path.stem in shipped_profiles()


def find_profile(
    name: str, beside: Path | None = None, within: Path | None = None, place: Mapping[str, object] | None = None
) -> Path:
    """File of a profile.

    Parameters
    ----------
    name : str
        ``"et-doc-foparq-a"``, or a path ending in ``.toml``.
    beside : Path, optional
        Folder that a relative path starts from.
    within : Path, optional
        Folder that a path may not leave, neither by its words nor by a link. Shipped profiles are found all the same.
    place : mapping, optional
        ``file`` and ``line`` where the name stands, for messages.

    Raises
    ------
    ProfileError
        If there is no such file, or it lies outside.
    """
    path = None
    if name.endswith(".toml"):
        path = (beside or Path()) / (name if within is None else name.replace("\\", "/"))
        if within is not None and not _inside(name, path, within):
            if place is not None:
                raise ProfileError("profile.outside-base", value=name[:_SHOWN], example=_EXAMPLE, **place)
            raise ProfileError("profile.outside", value=name[:_SHOWN], example=_EXAMPLE)
    elif "/" not in name and "\\" not in name:
        path = _folder() / f"{name}.toml"
    with contextlib.suppress(OSError, ValueError):  # of a name that no file can have
        if path is not None and path.is_file():
            return path
    fields = {"value": name[:_SHOWN], "known": ", ".join(nearest(name, shipped_profiles())), "example": _EXAMPLE}
    if place is not None:
        raise ProfileError("profile.unknown-base", **fields, **place)
    if odd := odd_letters(name):
        raise ProfileError("profile.unknown-odd", letters=shown_letters(odd), **fields)
    raise ProfileError("profile.unknown", **fields)


def _inside(name: str, path: Path, folder: Path) -> bool:
    if PurePosixPath(name).is_absolute() or PureWindowsPath(name).anchor:
        return False
    try:
        return path.resolve().is_relative_to(folder.resolve())
    except (OSError, RuntimeError, ValueError):  # a ring of links, a name that no file can have
        return False


def _folder() -> Path:
    return shipped("rules") / "profiles"
