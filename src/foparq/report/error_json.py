# SPDX-License-Identifier: MIT
"""What ended a run before there was anything to report, as JSON."""

from collections.abc import Mapping

from foparq.report.harmless import json_lines

SCHEMA = "foparq-error/1"


def error_json(message: str, text: str, fields: Mapping[str, object], code: int) -> list[str]:
    """An error as JSON, line by line.

    Parameters
    ----------
    message : str
        Id of the message, ``"manifest.no-scale"``; ``"usage"`` of a command line that was not understood.
    text : str
        Its sentence.
    fields : mapping
        What the sentence names.
    code : int
        Exit code.
    """
    plain = {
        name: value if isinstance(value, str | int | float | bool) else str(value) for name, value in fields.items()
    }
    return json_lines({"schema": SCHEMA, "exit": int(code), "error": {"id": message, "text": text, "fields": plain}})
