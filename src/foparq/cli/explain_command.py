# SPDX-License-Identifier: MIT
"""``foparq explain CODE``: the manual of one rule."""

import json

import click

from foparq.check.catalogue import find_card
from foparq.cli.common import format_option, language_option
from foparq.cli.lines import styled, tell
from foparq.cli.rules_command import as_json
from foparq.report.manual import manual_of
from foparq.report.words import Words


def command(say: Words) -> click.Command:
    """The subcommand in one language."""

    def run(rule: str, form: str) -> int:
        card = find_card(rule)
        sections = [(say(f"report.manual.{part.kind}") if part.kind else "", part) for part in manual_of(say, card)]
        mend = say(f"rules.{card.code}.mend")
        if form == "json":
            manual = "\n\n".join("\n".join(filter(None, (title, *part.paragraphs))) for title, part in sections)
            click.echo(json.dumps({**as_json(card, say), "manual": manual, "mend": mend}, ensure_ascii=False, indent=2))
            return 0
        click.echo(styled(f"{card.code} {card.name}", bold=True))
        click.echo(say(f"rules.{card.code}.title"))
        for title, part in sections:
            click.echo()
            if title:
                click.echo(styled(title, bold=True))
            for n, paragraph in enumerate(part.paragraphs):
                if n and not title:
                    click.echo()
                tell(paragraph)
        click.echo()
        click.echo(styled(say("cli.explain.mend"), bold=True))
        tell(mend)
        if card.measures:
            click.echo()
            tell(say("cli.explain.measures", measures=", ".join(card.measures)))
        return 0

    return click.Command(
        "explain", callback=run, help=say("cli.explain.help"), short_help=say("cli.explain.short"),
        params=[
            click.Argument(["rule"], metavar=say("cli.explain.rule")),
            format_option(say, ("text", "json")),
            language_option(say),
        ],
    )  # fmt: skip
