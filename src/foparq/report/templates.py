# SPDX-License-Identifier: MIT
"""The template environment: everything is escaped unless the shipped files themselves are meant."""

from functools import cache

import jinja2
from markupsafe import Markup

from foparq.resources import shipped


@cache
def environment(folder: str) -> jinja2.Environment:
    """Environment of a folder of templates: ``"page"`` or ``"style"``.

    Autoescape is on whatever the file is called, and a name that is not given is an error.
    """
    made = jinja2.Environment(
        loader=jinja2.FileSystemLoader(shipped("templates") / folder),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
    made.globals["shipped_text"] = shipped_text
    return made


def shipped_text(folder: str, name: str) -> Markup:
    """Text of a shipped style sheet or script, to stand in a page as it is.

    The only place where text enters a page unescaped: it comes from the installation, never from a delivery.

    Raises
    ------
    ValueError
        If the text would end the element it stands in.
    """
    text = (shipped("templates") / folder / name).read_text(encoding="utf-8")
    if "</" in text or "<!--" in text:
        raise ValueError(f"{name} cannot stand in a page: it holds markup")
    return Markup(text)  # noqa: S704 - shipped text, looked through above
