# SPDX-License-Identifier: MIT
"""``foparq explain CODE``: the manual of one rule."""

import json

import click

from foparq.check.catalogue import find_card
from foparq.cli.common import format_option, language_option
from foparq.cli.rules_command import as_json
from foparq.report.words import Words


def command(say: Words) -> click.Command:
    """The subcommand in one language."""

    def run(rule: str, form: str) -> int:
        card = find_card(rule)
        manual = say.find(f"rules.{card.code}.manual") or card.manual
        mend = say(f"rules.{card.code}.mend")
        if form == "json":
            click.echo(json.dumps({**as_json(card, say), "manual": manual, "mend": mend}, ensure_ascii=False, indent=2))
            return 0
        click.echo(click.style(f"{card.code} {card.name}", bold=True))
        click.echo(say(f"rules.{card.code}.title"))
        click.echo()
        click.echo(manual)
        click.echo()
        click.echo(click.style(say("cli.explain.mend"), bold=True))
        click.echo(mend)
        if card.measures:
            click.echo()
            click.echo(say("cli.explain.measures", measures=", ".join(card.measures)))
        return 0

    return click.Command(
        "explain", callback=run, help=say("cli.explain.help"), short_help=say("cli.explain.short"),
        params=[
            click.Argument(["rule"], metavar=say("cli.explain.rule")),
            format_option(say, ("text", "json")),
            language_option(say),
        ],
    )  # fmt: skip
