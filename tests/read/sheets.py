# SPDX-License-Identifier: MIT
"""Writers of small workbooks, XML by hand, so that formulas, errors and hostile members are as wanted."""

import zipfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from xml.sax.saxutils import escape, quoteattr

Rows = Sequence[Sequence[object]]
_MAIN = "http://schemas.openxmlformats.org/spreadsheetml/2006/main"
_OFFICE = "http://schemas.openxmlformats.org/officeDocument/2006/relationships"
_PACKAGE = "http://schemas.openxmlformats.org/package/2006"
_HEAD = '<?xml version="1.0" encoding="UTF-8"?>'
ODS = "application/vnd.oasis.opendocument.spreadsheet"


@dataclass(frozen=True)
class Formula:
    """A formula with the value that was stored for it; ``None``: none was."""

    text: str
    value: float | str | None = None


@dataclass(frozen=True)
class Failed:
    """A formula that failed."""

    shown: str = "#N/A"


@dataclass(frozen=True)
class Day:
    """The 12th of March 2026."""


@dataclass(frozen=True)
class Covered:
    """Merged with the cell above."""


def letters(place: int) -> str:
    return chr(ord("A") + place)


def xlsx(
    path: Path, rows: Rows, *, others: Mapping[str, Rows] | None = None, hidden: str = "", name: str = "Plan1",
) -> Path:  # fmt: skip
    sheets = {name: rows, **(others or {})}
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        relation = f"{_OFFICE.replace('/relationships', '')}/relationships"
        archive.writestr(
            "[Content_Types].xml",
            f'{_HEAD}<Types xmlns="{_PACKAGE}/content-types"><Default Extension="xml" ContentType="application/xml"/>'
            '<Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>'
            '<Override PartName="/xl/workbook.xml" ContentType='
            '"application/vnd.openxmlformats-officedocument.spreadsheetml.sheet.main+xml"/></Types>',
        )
        archive.writestr(
            "_rels/.rels",
            f'{_HEAD}<Relationships xmlns="{_PACKAGE}/relationships"><Relationship Id="r1" '
            f'Type="{relation}/officeDocument" Target="xl/workbook.xml"/></Relationships>',
        )
        targets = "".join(
            f'<Relationship Id="r{n}" Type="{relation}/worksheet" Target="worksheets/sheet{n}.xml"/>'
            for n in range(len(sheets))
        )
        styles = f'<Relationship Id="s" Type="{relation}/styles" Target="styles.xml"/>'
        archive.writestr(
            "xl/_rels/workbook.xml.rels",
            f'{_HEAD}<Relationships xmlns="{_PACKAGE}/relationships">{targets}{styles}</Relationships>',
        )
        listed = "".join(
            f"<sheet name={quoteattr(title)} sheetId='{n + 1}' r:id='r{n}'"
            f"{' state=' + quoteattr('hidden') if title == hidden else ''}/>"
            for n, title in enumerate(sheets)
        )
        archive.writestr(
            "xl/workbook.xml",
            f'{_HEAD}<workbook xmlns="{_MAIN}" xmlns:r="{_OFFICE}"><sheets>{listed}</sheets></workbook>',
        )
        archive.writestr(
            "xl/styles.xml",
            f'{_HEAD}<styleSheet xmlns="{_MAIN}"><fonts count="1"><font/></fonts>'
            '<fills count="1"><fill><patternFill patternType="none"/></fill></fills>'
            '<borders count="1"><border/></borders><cellStyleXfs count="1"><xf/></cellStyleXfs>'
            '<cellXfs count="2"><xf numFmtId="0"/><xf numFmtId="14" applyNumberFormat="1"/></cellXfs></styleSheet>',
        )
        for n, content in enumerate(sheets.values()):
            archive.writestr(f"xl/worksheets/sheet{n}.xml", _worksheet(content))
    return path


def _worksheet(rows: Rows) -> str:
    merged: list[str] = []
    body = ""
    for n, row in enumerate(rows, start=1):
        cells = ""
        for place, value in enumerate(row):
            if isinstance(value, Covered):
                merged.append(f'<mergeCell ref="{letters(place)}{n - 1}:{letters(place)}{n}"/>')
            cells += _xlsx_cell(f"{letters(place)}{n}", value)
        body += f'<row r="{n}">{cells}</row>'
    ranges = f'<mergeCells count="{len(merged)}">{"".join(merged)}</mergeCells>' if merged else ""
    return f'{_HEAD}<worksheet xmlns="{_MAIN}"><sheetData>{body}</sheetData>{ranges}</worksheet>'


def _xlsx_cell(address: str, value: object) -> str:  # noqa: PLR0911 - one for each kind
    if value is None or isinstance(value, Covered):
        return ""
    if isinstance(value, Failed):
        return f'<c r="{address}" t="e"><f>NA()</f><v>{value.shown}</v></c>'
    if isinstance(value, Day):
        return f'<c r="{address}" s="1"><v>46093</v></c>'
    if isinstance(value, bool):
        return f'<c r="{address}" t="b"><v>{value:d}</v></c>'
    if isinstance(value, Formula):
        kind = ' t="str"' if isinstance(value.value, str) else ""
        stored = "" if value.value is None else f"<v>{value.value!s}</v>"
        return f'<c r="{address}"{kind}><f>{escape(value.text)}</f>{stored}</c>'
    if isinstance(value, int | float):
        return f'<c r="{address}"><v>{value!r}</v></c>'
    return f'<c r="{address}" t="inlineStr"><is><t xml:space="preserve">{escape(str(value))}</t></is></c>'


def ods(
    path: Path, rows: Rows, *, others: Mapping[str, Rows] | None = None, hidden: str = "", name: str = "Plan1"
) -> Path:
    spaces = " ".join(
        f'xmlns:{short}="urn:oasis:names:tc:opendocument:xmlns:{short}:1.0"'
        for short in ("office", "table", "text", "style")
    )
    calc = 'xmlns:calcext="urn:org:documentfoundation:names:experimental:calc:xmlns:calcext:1.0"'
    filler = (
        '<table:table-row table:number-rows-repeated="1048000">'
        '<table:table-cell table:number-columns-repeated="16384"/></table:table-row>'
    )
    end = '<table:table-cell table:number-columns-repeated="16000"/>\n</table:table-row>'
    tables = "".join(
        f"<table:table table:name={quoteattr(title)} table:style-name='{'ta2' if title == hidden else 'ta1'}'>"
        + "".join(f"<table:table-row>{''.join(map(_ods_cell, row))}{end}" for row in content)
        + f"{filler}</table:table>"
        for title, content in {name: rows, **(others or {})}.items()
    )
    styles = "".join(
        f'<style:style style:name="{style}" style:family="table">'
        f'<style:table-properties table:display="{shown}"/></style:style>'
        for style, shown in (("ta1", "true"), ("ta2", "false"))
    )
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("mimetype", ODS, zipfile.ZIP_STORED)
        archive.writestr(
            "content.xml",
            f"{_HEAD}<office:document-content {spaces} {calc}>"
            f"<office:automatic-styles>{styles}</office:automatic-styles>"
            f"<office:body><office:spreadsheet>{tables}</office:spreadsheet></office:body></office:document-content>",
        )
    return path


def _ods_cell(value: object) -> str:  # noqa: PLR0911
    if value is None:
        return "<table:table-cell/>"
    if isinstance(value, Covered):
        return "<table:covered-table-cell/>"
    if isinstance(value, Failed):
        return (
            '<table:table-cell table:formula="of:=NA()" office:value-type="string" office:string-value="" '
            f'calcext:value-type="error"><text:p>{value.shown}</text:p></table:table-cell>'
        )
    if isinstance(value, Day):
        return (
            '<table:table-cell office:value-type="date" office:date-value="2026-03-12"><text:p>12/03/26</text:p>'
            "</table:table-cell>"
        )
    if isinstance(value, bool):
        return f'<table:table-cell office:value-type="boolean" office:boolean-value="{str(value).lower()}"/>'
    if isinstance(value, Formula):
        inner = "" if value.value is None else _ods_cell(value.value)
        formula = f"table:formula={quoteattr('of:=' + value.text)}"
        return f"<table:table-cell {formula}" + (inner.removeprefix("<table:table-cell") if inner else "/>")
    if isinstance(value, int | float):
        shown = f"<text:p>{value:.2f}</text:p></table:table-cell>"
        return f'<table:table-cell office:value-type="float" office:value="{value!r}">{shown}'
    words = escape(str(value)).replace("  ", '<text:s text:c="2"/>')
    return (
        '<table:table-cell office:value-type="string"><office:annotation><text:p>nota</text:p></office:annotation>'
        f"<text:p>{words}</text:p></table:table-cell>"
    )
