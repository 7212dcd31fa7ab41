# SPDX-License-Identifier: MIT
"""Names of a delivery that nothing obeys: no terminal, no spreadsheet, no reader of line breaks.

What people read goes through :func:`foparq.report.words.printable`. Programs read JSON and tables: JSON keeps the very
name behind escapes, a table has no escapes of its own and shows them.
"""

import json
import re
from collections.abc import Sequence

from foparq.report.words import printable

_encode = json.JSONEncoder(ensure_ascii=False).encode
_indent = json.JSONEncoder(ensure_ascii=False, indent=2).encode

#: Begins a formula: the wide forms of East Asian keyboards too, also after blanks and what was escaped. A semicolon
#: opens a cell where the comma is the decimal sign.
_FORMULA = re.compile(r"(^|;)(?=(?: |\\u[0-9a-f]{4,6})*[=+\-@＝＋－＠])")


def json_line(value: object) -> str:
    """JSON of a value in one line, letters that are not printable as escapes."""
    return _escaped(_encode(value))


def json_lines(value: object) -> list[str]:
    """JSON of a value, indented, line by line."""
    return [_escaped(line) for line in _indent(value).split("\n")]


def _escaped(text: str) -> str:
    # Such letters stand in strings only, where the escape means the same.
    return text if text.isprintable() else "".join(c if c.isprintable() else json.dumps(c)[1:-1] for c in text)


def cell(value: object) -> object:
    """Value as a cell of a table that a spreadsheet may open.

    Returns
    -------
    object
        A text is printable, with an apostrophe before what would begin a formula; a number stays a number.
    """
    if not isinstance(value, str):
        return value
    shown = printable(value)
    plain = ";" not in shown and (not shown or shown[0].isalnum())  # nearly all: not worth a search
    return shown if plain else _FORMULA.sub(r"\1'", shown)


def log_text(traces: Sequence[str]) -> str:
    """Tracebacks as text; they name what is delivered."""
    return "\n".join(printable(line) for trace in traces for line in trace.split("\n"))
