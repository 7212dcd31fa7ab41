# SPDX-License-Identifier: MIT
"""What people confirm by name in the manifest."""

from pathlib import PurePosixPath

from foparq.errors import ManifestError
from foparq.model.statements import Confirmation
from foparq.names import folded
from foparq.profile.manifest import ConfirmedSection, DrawingSection, Manifest, MeshSection

_ONLY = {"checkpoints": ["not drawn"], "distances": ["not drawn"], "commission": ["none"]}
_BY_AXES = "given"  #: a plane of an origin and two axes


def confirmed(manifest: Manifest, file: str) -> tuple[Confirmation, ...]:
    """Confirmations of a manifest, in its order.

    Parameters
    ----------
    file : str
        Its name, for errors.

    Raises
    ------
    ManifestError
        If one speaks of nothing that the manifest states: a slip would leave open what somebody means to have settled.
    """
    for one in manifest.confirmed:
        stated = _stated(one, manifest)
        if stated is not None and folded(one.value) not in {folded(value) for value in stated}:
            example = ", ".join(f'value = "{value}"' for value in dict.fromkeys(stated))
            raise ManifestError(
                "manifest.confirms-nothing", file=file, key=f"confirmed.{one.what}", value=one.value,
                example=example or f'{one.what} = "{one.value}"',
            )  # fmt: skip
    return tuple(Confirmation(**one.model_dump()) for one in manifest.confirmed)


def confirms(one: ConfirmedSection, section: DrawingSection | MeshSection) -> bool:
    """Whether a person confirms what the manifest states of a drawing or a mesh."""
    stated = _value(section, one.what) if one.what in {"unit", "plane"} else ""
    return bool(stated) and folded(stated) == folded(one.value) and _speaks_of(one, section)


def _value(section: DrawingSection | MeshSection, what: str) -> str:
    """What the manifest states, as a person repeats it; ``""`` if it states nothing."""
    value = getattr(section, what, None)
    return _BY_AXES if isinstance(value, tuple) else value or ""


def _stated(one: ConfirmedSection, manifest: Manifest) -> list[str] | None:
    """Values that could be confirmed; ``None`` if any may be: a scale may be the reviewer's."""
    if one.what in _ONLY:
        return _ONLY[one.what]
    if one.what in {"unit", "plane", "facade"}:
        every: list[DrawingSection | MeshSection] = [*manifest.drawing, *manifest.mesh]
        named = [section for section in every if _speaks_of(one, section)]
        return [value for section in named if (value := _value(section, one.what))]
    return None


def _speaks_of(one: ConfirmedSection, section: DrawingSection | MeshSection) -> bool:
    """Whether a person speaks of a drawing or a mesh: by its path, however it is spelt, or of all."""
    return not one.path or _path_key(one.path) == _path_key(section.path)


def _path_key(path: str) -> str:
    return folded(PurePosixPath(path.replace("\\", "/")).as_posix())
