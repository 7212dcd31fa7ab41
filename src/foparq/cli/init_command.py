# SPDX-License-Identifier: MIT
"""``foparq init DIR``: a commented manifest from the files found."""

from pathlib import Path
from typing import Any

import click

from foparq.cli.common import language_option
from foparq.report.words import Words


def command(say: Words) -> click.Command:
    """The subcommand in one language."""

    def run(**options: Any) -> int:  # noqa: ANN401 - click hands over what the parameters say
        from foparq.cli.init_work import init_work  # noqa: PLC0415 - the readers load when there is work

        return init_work(say, **options)

    return click.Command(
        "init", callback=run, help=say("cli.init.help"), short_help=say("cli.init.short"),
        params=[
            click.Argument(["folder"], metavar=say("cli.init.dir"), type=click.Path(path_type=Path)),
            click.Option(["--force"], is_flag=True, help=say("cli.init.force")),
            language_option(say),
        ],
    )  # fmt: skip
