# SPDX-License-Identifier: MIT
"""``foparq doctor``: what is installed and whether it works."""

import click

from foparq.cli.common import format_option, language_option
from foparq.report.words import Words


def command(say: Words) -> click.Command:
    """The subcommand in one language."""

    def run(form: str) -> int:
        from foparq.cli.doctor_work import doctor_work  # noqa: PLC0415 - the geometry engine loads when there is work

        return doctor_work(say, form=form)

    return click.Command(
        "doctor", callback=run, help=say("cli.doctor.help"), short_help=say("cli.doctor.short"),
        params=[format_option(say, ("text", "json")), language_option(say)],
    )  # fmt: skip
