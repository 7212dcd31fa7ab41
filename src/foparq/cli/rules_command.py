# SPDX-License-Identifier: MIT
"""``foparq rules``: every rule in a line."""

import json

import click

from foparq.check.catalogue import Card, cards
from foparq.cli.common import format_option, language_option
from foparq.report.words import Words


def command(say: Words) -> click.Command:
    """The subcommand in one language."""

    def run(form: str) -> int:
        every = cards()
        if form == "json":
            click.echo(json.dumps([as_json(card, say) for card in every], ensure_ascii=False, indent=2))
            return 0
        width = max(len(card.name) for card in every)
        for card in every:
            preview = f" [{say('cli.rules.preview')}]" if card.preview else ""
            click.echo(f"{card.code}  {card.name:<{width}}  {say(f'rules.{card.code}.title')}{preview}")
        return 0

    return click.Command(
        "rules", callback=run, help=say("cli.rules.help"), short_help=say("cli.rules.short"),
        params=[format_option(say, ("text", "json")), language_option(say)],
    )  # fmt: skip


def as_json(card: Card, say: Words) -> dict[str, object]:
    """A rule as JSON values."""
    return {
        "code": card.code, "name": card.name, "title": say(f"rules.{card.code}.title"), "input": card.subject,
        "tolerances": dict(card.tolerances), "measures": list(card.measures), "requires": list(card.requires),
        "preview": card.preview,
    }  # fmt: skip
