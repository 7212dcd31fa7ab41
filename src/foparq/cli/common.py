# SPDX-License-Identifier: MIT
"""What commands share: the language option, formats, progress."""

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

import click

from foparq.report.formats import SHOWN
from foparq.report.words import LANGUAGES, Words

_PATIENCE = 1.0  #: seconds before progress is shown


def language_option(say: Words) -> click.Option:
    """``--lang``, also behind the subcommand; it was read before."""
    return click.Option(["--lang"], type=click.Choice(LANGUAGES), expose_value=False, help=say("cli.option.lang"))


def format_option(say: Words, formats: tuple[str, ...] = SHOWN) -> click.Option:
    """``--format``."""
    return click.Option(
        ["--format", "form"],
        type=click.Choice(formats),
        default="text",
        show_default=True,
        help=say("cli.option.format"),
    )


@contextmanager
def progress_on_stderr(say: Words) -> Iterator[Callable[[str], None]]:
    """Tell what is being done on stderr, if it is a terminal and takes longer than a second.

    Yields
    ------
    callable
        To be told the name of each step.
    """
    if sys.stderr is None or not sys.stderr.isatty():
        yield lambda _step: None
        return
    from rich.console import Console  # noqa: PLC0415 - only for a person at a terminal
    from rich.text import Text  # noqa: PLC0415

    start = time.monotonic()
    with Console(stderr=True).status(Text("")) as status:
        status.stop()

        def tell(step: str) -> None:
            if time.monotonic() - start > _PATIENCE:
                status.update(Text(say("cli.progress", step=step)))
                status.start()

        yield tell
