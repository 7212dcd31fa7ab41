# SPDX-License-Identifier: MIT
"""Entry of the command ``foparq``."""

import signal
import sys
import warnings

# What libraries warn of is no business of who runs the command. Who asks with ``-W`` is told of foparq's own code only.
warnings.filterwarnings("ignore", module=r"(?!foparq\b)" if sys.warnoptions else "")

from foparq.cli.main import run  # noqa: E402 - libraries warn while they are loaded, too


def main() -> None:
    """Run the command and leave with its exit code."""
    # Asked to end, leave as if interrupted: what was being written is taken away.
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    sys.exit(run(sys.argv[1:]))


if __name__ == "__main__":
    main()
