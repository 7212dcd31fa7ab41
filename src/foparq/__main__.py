# SPDX-License-Identifier: MIT
"""Entry of the command ``foparq``."""

import sys

from foparq.cli.main import run


def main() -> None:
    """Run the command and leave with its exit code."""
    sys.exit(run(sys.argv[1:]))


if __name__ == "__main__":
    main()
