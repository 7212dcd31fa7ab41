# SPDX-License-Identifier: MIT
"""What commands share: the language option, formats, progress."""

import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import click

from foparq.names import nearest
from foparq.report.formats import SHOWN
from foparq.report.words import LANGUAGES, Words, language_named

#: steps that are told with a sentence of their own
_SENTENCES = {"compiling": "cli.compiling"}
_PATIENCE = 1.0  #: seconds before progress is shown


@dataclass
class Spoken:
    """In which language the command speaks: as asked, else as a manifest says, else the locale's."""

    asked: str | None
    say: Words

    def turn_to(self, language: str | None) -> Words:
        """Speak the language of a manifest, unless another was asked for."""
        if self.asked is None and language is not None:
            self.say = Words(language)
        return self.say


class OneOf(click.Choice):  # type: ignore[type-arg]
    """One of some words; an unknown one is answered with all of them, the nearest first."""

    def __init__(self, say: Words, words: Sequence[str]) -> None:
        super().__init__(list(words))
        self.say = say

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:  # noqa: ANN401 - click's signature
        """The word as it is known."""
        if value not in self.choices:
            known = nearest(str(value), map(str, self.choices))
            self.fail(self.say("cli.unknown-choice", value=str(value), known=known), param, ctx)
        return super().convert(value, param, ctx)


class Language(OneOf):
    """A language by its tag: ``pt`` is ``pt-BR``."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:  # noqa: ANN401 - click's signature
        """The language that is spoken."""
        return super().convert(language_named(str(value)) or value, param, ctx)


def language_option(say: Words) -> click.Option:
    """``--lang``, before or behind the subcommand; it was read before."""
    return click.Option(["--lang"], type=Language(say, LANGUAGES), expose_value=False, help=say("cli.option.lang"))


def format_option(say: Words, formats: tuple[str, ...] = SHOWN) -> click.Option:
    """``--format``."""
    return click.Option(
        ["--format", "form"],
        type=OneOf(say, formats),
        default="text",
        show_default=True,
        help=say("cli.option.format"),
    )


@contextmanager
def progress_on_stderr(say: Words) -> Iterator[Callable[[str], None]]:
    """Tell what is being done on stderr, if it is a terminal and takes longer than a second.

    What takes long the first time only is told in any case.

    Yields
    ------
    callable
        To be told the name of each step.
    """
    if sys.stderr is None or not sys.stderr.isatty():

        def say_at_once(step: str) -> None:
            if step in _SENTENCES and sys.stderr is not None:
                click.echo(say(_SENTENCES[step]), err=True)

        yield say_at_once
        return
    from rich.console import Console  # noqa: PLC0415 - only for a person at a terminal
    from rich.text import Text  # noqa: PLC0415

    start = time.monotonic()
    with Console(stderr=True).status(Text("")) as status:
        status.stop()

        def tell(step: str) -> None:
            if time.monotonic() - start > _PATIENCE or step in _SENTENCES:
                status.update(Text(say(_SENTENCES.get(step, "cli.progress"), step=step)))
                status.start()

        yield tell
