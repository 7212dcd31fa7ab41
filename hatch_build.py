# SPDX-License-Identifier: MIT
"""Build step: compile the message catalogues (.po) to what gettext reads (.mo)."""

from pathlib import Path
from typing import Any

from babel.messages.mofile import write_mo
from babel.messages.pofile import read_po
from hatchling.builders.hooks.plugin.interface import BuildHookInterface


class CatalogueHook(BuildHookInterface):  # type: ignore[misc, type-arg]
    """Write ``NAME.mo`` beside every ``NAME.po`` of the templates folder."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:  # noqa: ARG002 - the hook's signature
        """Compile; refuse a catalogue that does not parse."""
        for source in sorted(Path(self.root, "reports/templates/locale").rglob("*.po")):
            with source.open("rb") as stream:
                catalogue = read_po(stream, abort_invalid=True)
            with source.with_suffix(".mo").open("wb") as target:
                write_mo(target, catalogue)
