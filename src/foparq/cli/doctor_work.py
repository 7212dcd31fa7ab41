# SPDX-License-Identifier: MIT
"""What ``foparq doctor`` does."""

import json
import platform
import sys

import click

from foparq.audit import versions
from foparq.check.registry import all_rules
from foparq.check.validate import validate_checks
from foparq.errors import FoparqError
from foparq.profile.load import load_profile, shipped_profiles
from foparq.read.versions import drivers
from foparq.report.words import LANGUAGES, Words


def doctor_work(say: Words, *, form: str) -> int:
    """Tell versions and try the parts; returns 0 if all work, 3 if one does not."""
    facts = {"Python": platform.python_version(), "platform": platform.platform(), **versions()}
    trials = _trials()
    if form == "json":
        click.echo(
            json.dumps(
                {"versions": facts, "trials": {name: not why for name, why in trials}, "executable": sys.executable},
                indent=2,
            )
        )
    else:
        for name, version in facts.items():
            click.echo(f"{name:<10} {version}")
        for name, why in trials:
            click.echo(f"{name:<40} {say('cli.doctor.works') if not why else say('cli.doctor.fails', why=why)}")
    return 3 if any(why for _, why in trials) else 0


def _trials() -> list[tuple[str, str]]:
    """Name of each part and why it does not work; an empty text if it does."""
    trials = [(f"GDAL driver {name}", "" if works else "missing") for name, works in drivers().items()]
    trials.append((f"{len(all_rules())} rules", ""))
    for name in shipped_profiles():
        try:
            validate_checks(load_profile(name))
        except FoparqError as error:
            trials.append((f"profile {name}", str(error)))
        else:
            trials.append((f"profile {name}", ""))
    for language in LANGUAGES:
        missing = Words(language).find("cli.foparq") is None
        trials.append((f"messages {language}", "not compiled: install foparq again" if missing else ""))
    return trials
