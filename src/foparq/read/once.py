# SPDX-License-Identifier: MIT
"""One file that becomes a part of the delivery: taken once, identified, read in the guarded child."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import TypeVar

from foparq.errors import InputError, ManifestError
from foparq.model.delivery import Source, SourceStatus
from foparq.read.guard.parent import guarded
from foparq.read.intake import Intake, identified, refused, take_once

R = TypeVar("R")


def read_once(
    intake: Intake, source: Source, find: Callable[[], Path], read: Callable[..., R], *more: object
) -> tuple[Path | None, Source, R | None]:
    """What a file holds, or the source that says why nothing of it was read.

    Parameters
    ----------
    source : Source
        Path and role; as refused.
    find : callable
        Finds the file, within the folder of the delivery where that is asked for.
    read : callable
        Called in the child with the path and ``more``.

    Returns
    -------
    path : Path or None
        Where it was found.
    source : Source
        With size and hash; as missing or refused if nothing was read.
    held : object or None

    Raises
    ------
    ManifestError
        If the manifest names the file twice, or says of it what cannot be.
    """
    name, limits = source.path, intake.profile.limits
    intake.tell(name)
    path = None
    try:
        path = find()
        take_once(intake, path, name)
        source = identified(source, path, limits.bytes)
        if source.status is SourceStatus.MISSING:
            return path, source, None
        held = guarded(read, path, *more, file=name, seconds=limits.seconds, memory=limits.memory)
    except InputError as error:
        return path, refused(source, name, error.message, error.fields), None
    except RuntimeError as error:
        intake.crashes.append(f"{name}\n{error}")
        return path, refused(source, name, "read.crashed", {}), None
    except ManifestError as error:
        raise ManifestError(error.message, **{**error.fields, "file": name}) from None
    return path, replace(source, status=SourceStatus.READ), held
