# SPDX-License-Identifier: MIT
"""``foparq check FILE...``: loose drawings, without a manifest."""

from pathlib import Path
from typing import Any

import click

from foparq.cli.common import OneOf, format_option, language_option
from foparq.report.words import Words


def command(say: Words) -> click.Command:
    """The subcommand in one language."""

    def run(**options: Any) -> int:  # noqa: ANN401 - click hands over what the parameters say
        from foparq.cli.check_work import check_work  # noqa: PLC0415 - the geometry engine loads when there is work

        return check_work(say, **options)

    return click.Command(
        "check",
        callback=run,
        help=say("cli.check.help"),
        short_help=say("cli.check.short"),
        epilog=say("cli.check.exits"),
        params=[
            click.Argument(
                ["files"],
                metavar=say("cli.check.files"),
                nargs=-1,
                required=True,
                type=click.Path(path_type=Path, exists=True, dir_okay=False),
            ),
            click.Option(["--profile"], default="et-doc-foparq-a", show_default=True, help=say("cli.check.profile")),
            click.Option(["--scale"], metavar="1:K", help=say("cli.check.scale")),
            click.Option(["--unit"], metavar="UNIT", help=say("cli.check.unit")),
            click.Option(
                ["--plane"],
                type=OneOf(say, ["xy", "xz", "yz", "fit"]),
                help=say("cli.check.plane"),
            ),
            click.Option(["--areas"], metavar="LAYER", multiple=True, help=say("cli.check.areas")),
            click.Option(["--bind"], metavar="LAYER,LAYER", multiple=True, help=say("cli.check.bind")),
            click.Option(["--ignore-layers"], metavar="LAYER", multiple=True, help=say("cli.check.ignore-layers")),
            click.Option(["--closed/--open", "closed"], default=None, help=say("cli.check.closed")),
            click.Option(["--rims"], metavar="N", type=click.IntRange(1, 10**6), help=say("cli.check.rims")),
            click.Option(["--select"], metavar="RULE", multiple=True, help=say("cli.check.select")),
            click.Option(["--ignore"], metavar="RULE", multiple=True, help=say("cli.check.ignore")),
            click.Option(
                ["--set", "settings"], metavar="RULE.TOLERANCE=QUANTITY", multiple=True, help=say("cli.check.set")
            ),
            click.Option(
                ["--out"], metavar="DIR", type=click.Path(path_type=Path, file_okay=False), help=say("cli.check.out")
            ),
            format_option(say),
            language_option(say),
        ],
    )
