# SPDX-License-Identifier: MIT
"""What ``foparq init`` does: a manifest proposed from the files found, and what is left to a person to say."""

from pathlib import Path

import click

from foparq.audit import MANIFEST
from foparq.cli.init_text import PROFILE, also_line, manifest_text, other_line, rival
from foparq.cli.lines import tell
from foparq.errors import ManifestError, WriteError
from foparq.profile.load import load_profile
from foparq.read.table.revisions import revision_of
from foparq.read.table.survey import Survey, survey_folder
from foparq.report.words import Words


def init_work(say: Words, *, folder: Path, force: bool) -> int:
    """Write ``delivery.toml`` into a folder; returns the exit code."""
    if not folder.is_dir():
        raise ManifestError("manifest.no-folder", file=str(folder), example="foparq init fixtures/deliveries/station-a")
    path = folder / MANIFEST
    if path.exists() and not force:
        raise ManifestError("manifest.exists", file=str(path), example=f'foparq init "{folder}" --force')
    found = survey_folder(folder, load_profile(PROFILE))
    if not (found.drawings or found.meshes):
        raise _nothing(folder, found, say)
    try:
        path.write_text(manifest_text(found, folder.resolve().name, say), encoding="utf-8")
    except UnicodeEncodeError as error:
        named = error.object[max(0, error.start - 20) : error.end + 20].strip()
        raise ManifestError("manifest.name-not-utf8", file=str(folder), value=named) from None
    except OSError as error:
        why = error.strerror or str(error)
        raise WriteError("write.folder", file=str(folder), value=why, example=f'foparq init "{folder}"') from None
    click.echo(say("cli.init.done", file=str(path), folder=str(folder)))
    for line in _asked(found, say):
        tell(line, "  - ")
    return 0


def _nothing(folder: Path, found: Survey, say: Words) -> ManifestError:
    """Error of a folder without a drawing that can be read; says of the files there what would make them one."""
    told = [say(f"errors.{one.message}", **dict(one.fields)) for one in found.others if one.message and not one.role]
    if told:
        return ManifestError("manifest.nothing-but", file=str(folder), value=" ".join(told))
    return ManifestError("manifest.nothing", file=str(folder), example='foparq init "my-delivery"')


def _asked(found: Survey, say: Words) -> list[str]:
    """Questions that the files raise: revisions, tables that were taken for none, drawings that cannot be read."""
    lines = [asked.partition("\n")[0] for one in found.drawings if (asked := rival(one, found.drawings, say))]
    for first, *others in found.tables.values():
        same = [other for other in others if revision_of(other.path).base == revision_of(first.path).base]
        lines += [also_line(first, other, say) for other in same if other.path != first.path]
    return lines + [other_line(one, say) for one in found.others if one.message or one.aside]
