# SPDX-License-Identifier: MIT
"""``foparq audit DELIVERY``: the main job."""

from pathlib import Path
from typing import Any

import click

from foparq.cli.common import format_option, language_option
from foparq.report.words import Words


def command(say: Words) -> click.Command:
    """The subcommand in one language."""

    def run(**options: Any) -> int:  # noqa: ANN401 - click hands over what the parameters say
        from foparq.cli.audit_work import audit_work  # noqa: PLC0415 - the geometry engine loads when there is work

        return audit_work(spoken=click.get_current_context().obj, **options)

    return click.Command(
        "audit",
        callback=run,
        help=say("cli.audit.help"),
        short_help=say("cli.audit.short"),
        epilog=say("cli.audit.exits"),
        params=[
            click.Argument(["delivery"], metavar=say("cli.audit.delivery"), type=click.Path(path_type=Path)),
            click.Option(["--profile"], metavar=say("cli.audit.profile-value"), help=say("cli.audit.profile")),
            click.Option(["--scale"], metavar="1:K", help=say("cli.audit.scale")),
            click.Option(
                ["--out"], metavar="DIR", type=click.Path(path_type=Path, file_okay=False), help=say("cli.audit.out")
            ),
            format_option(say),
            language_option(say),
        ],
    )
