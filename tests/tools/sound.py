# SPDX-License-Identifier: MIT
"""How many sound deliveries are accepted: ``python -m tests.tools.sound --count 60 --seed 1``."""

import argparse
import tempfile
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any
from unittest.mock import patch

from tests.tools.office_files import write
from tests.tools.offices import Office, office

from foparq.audit import Audit, audit
from foparq.report.sentences import reason_sentence
from foparq.report.words import Words


@contextmanager
def unguarded() -> Iterator[None]:
    """Audits in this process: what the guards keep away is not here, and a child for each reader takes its time."""

    def straight(function: Any, *args: Any, **_: Any) -> Any:
        return function(*args)

    def stream(function: Any, args: tuple[Any, ...], **_: Any) -> Any:
        return function(*args)

    with (
        patch("foparq.read.delivery.guarded", straight), patch("foparq.bounded.streamed", stream),
        warnings.catch_warnings(),
    ):  # fmt: skip
        warnings.simplefilter("ignore")
        yield


def audited(made: Office, folder: Path) -> Audit:
    """Audit of a delivery in a new folder."""
    with unguarded():
        return audit(write(made, folder))


def main() -> None:
    """Audit some deliveries and print which are accepted."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=60)
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    words, accepted = Words("en"), 0
    with tempfile.TemporaryDirectory() as folder:
        for seed in range(given.seed, given.seed + given.count):
            made = office(seed)
            quality = audited(made, Path(folder) / str(seed)).record.quality
            accepted += quality.verdict == "accepted"
            habits = f"{made.format} {made.version} {made.plane} {made.unit} 1:{made.scale} {made.blocks or 'loose'}"
            habits += f" {made.style.name} {made.table_unit} {made.digits} {'told' if made.told else 'taken'}"
            print(f"{seed:5} {quality.verdict:10} {habits}")
            if quality.verdict != "accepted":
                print("      " + reason_sentence(words, quality.why[0]))
    print(f"{accepted} of {given.count} accepted at once")


if __name__ == "__main__":
    main()
