# SPDX-License-Identifier: MIT
"""Every kind of report. A new one is one entry here and the function it names."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class Format:
    """One kind of report.

    A function of a format is named, not held: ``--help`` lists formats without loading what makes them.
    """

    name: str  #: as ``--format`` takes it
    file: str = ""  #: name in the folder of reports; ``""`` if it is never a file
    lines: str = ""  #: ``"module:function"`` in ``foparq.report``: a record to its lines of text
    writer: str = ""  #: the same for what is no text: a record to a file at a path
    terminal: bool = False  #: laid out by the command for the terminal at hand

    @property
    def shown(self) -> bool:
        """Whether it can go to standard output."""
        return self.terminal or bool(self.lines)


FORMATS = (
    Format(name="text", terminal=True),
    Format(name="concise", terminal=True),
    Format(name="json", file="audit.json", lines="audit_json:audit_json_lines"),
    Format(name="jsonl", file="findings.jsonl", lines="findings_text:findings_jsonl"),
    Format(name="csv", lines="findings_text:findings_csv"),
    Format(name="gpkg", file="findings.gpkg", writer="findings_gpkg:write_findings_gpkg"),
    Format(name="iso19157", file="quality.xml", writer="iso19157:write_quality_xml"),
    Format(name="html", file="report.html", writer="page.page:write_page"),
)
SHOWN = tuple(form.name for form in FORMATS if form.shown)  #: choices of ``--format``
WRITTEN = tuple(form for form in FORMATS if form.file)  #: what a folder of reports holds


def format_named(name: str) -> Format:
    """The format of that name."""
    return next(form for form in FORMATS if form.name == name)
