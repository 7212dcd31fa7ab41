# SPDX-License-Identifier: MIT
"""Entry of the command ``foparq``."""

import signal
import sys

from foparq.cli.main import run


def main() -> None:
    """Run the command and leave with its exit code."""
    # Asked to end, leave as if interrupted: what was being written is taken away.
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    sys.exit(run(sys.argv[1:]))


if __name__ == "__main__":
    main()
