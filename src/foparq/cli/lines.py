# SPDX-License-Identifier: MIT
"""Lines of the terminal: wrapped to its width, coloured where it knows colours."""

import os
import shutil
import sys
import textwrap
from typing import Any

import click

_WIDEST = 120  #: letters of a line that are read with ease
_NARROWEST = 40


def width() -> int | None:
    """Letters in a line; ``None`` where nobody watches: a sentence in a file or pipe stays one line."""
    if "COLUMNS" not in os.environ and not (sys.stdout is not None and sys.stdout.isatty()):
        return None
    columns = shutil.get_terminal_size((_WIDEST, 24)).columns
    return max(_NARROWEST, min(columns, _WIDEST))


def wrapped(text: str, indent: str = "", hanging: str | None = None) -> str:
    """Text in lines of the terminal; words, names and places are never broken.

    Parameters
    ----------
    indent : str
        Before the first line.
    hanging : str, optional
        Before the others; as many blanks as the first has letters, if left out.
    """
    columns = width()
    if columns is None:
        return f"{indent}{text}"
    return textwrap.fill(
        text, columns, initial_indent=indent, subsequent_indent=" " * len(indent) if hanging is None else hanging,
        break_long_words=False, break_on_hyphens=False,
    )  # fmt: skip


def tell(text: str, indent: str = "", hanging: str | None = None) -> None:
    """Write a text to standard output, wrapped."""
    click.echo(wrapped(text, indent, hanging))


def styled(text: str, **style: Any) -> str:  # noqa: ANN401 - click's own arguments
    """Text with colour, unless the user asked for none (no-color.org) or the terminal knows none."""
    plain = os.environ.get("NO_COLOR") or os.environ.get("TERM") == "dumb"
    return text if plain else click.style(text, **style)
