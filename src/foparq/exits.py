# SPDX-License-Identifier: MIT
"""Exit codes and what they mean, for the command and whatever runs it: a batch, a server, a script."""

from enum import IntEnum

from foparq.errors import FoparqError, InputError, UsageError, WriteError


class Exit(IntEnum):
    """Exit codes of the command; scripts rely on them."""

    ACCEPTED = 0  #: accepted, or clean
    REJECTED = 1  #: rejected, or faults
    USAGE = 2  #: arguments, profile or manifest wrong; results cannot be written
    UNDECIDED = 3  #: evidence missing, undecidable, rule crashed, limit hit
    REFUSED = 4  #: input unreadable or unsafe
    CRASHED = 70  #: foparq itself failed; nothing is said about the delivery
    STOPPED = 130  #: interrupted by the user
    PIPE = 141  #: nobody reads the output any more


def exit_of_error(error: FoparqError) -> Exit:
    """Exit code of what ended a run before there was a conclusion."""
    if isinstance(error, InputError):
        return Exit.REFUSED
    return Exit.USAGE if isinstance(error, UsageError | WriteError) else Exit.UNDECIDED
