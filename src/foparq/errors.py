# SPDX-License-Identifier: MIT
"""What foparq raises when it cannot go on.

A fault of the delivery is never an exception: it is a finding. An error carries a message id of the ``errors``
catalogue and the values to fill in; the sentence is made where the language of the user is known.
"""


class FoparqError(Exception):
    """Root of all errors that foparq raises on purpose.

    Parameters
    ----------
    message : str
        Id of the sentence in the ``errors`` catalogue, ``"profile.unknown-key"``.
    **fields : object
        What the sentence names: ``file``, ``line``, ``key``, ``value``, ``example`` ...
    """

    def __init__(self, message: str, **fields: object) -> None:
        super().__init__(message, fields)
        self.message = message
        self.fields = fields

    def __reduce__(self) -> tuple[object, ...]:
        return _rebuild, (type(self), self.message, self.fields)

    def __str__(self) -> str:
        named = ", ".join(f"{name}={value!r}" for name, value in self.fields.items())
        return f"{self.message}: {named}" if named else self.message


def _rebuild(kind: type[FoparqError], message: str, fields: dict[str, object]) -> FoparqError:
    return kind(message, **fields)


class UsageError(FoparqError):
    """The request is wrong: arguments, profile or manifest (exit 2)."""


class QuantityError(UsageError):
    """A quantity is not a number with a known unit."""


class ProfileError(UsageError):
    """A profile cannot be used."""


class ManifestError(UsageError):
    """A delivery manifest cannot be used."""


class InputError(FoparqError):
    """A delivered file cannot be audited (exit 4)."""


class UnreadableError(InputError):
    """A delivered file is broken, or not what its name says."""


class UnsafeError(InputError):
    """A delivered file would cost unbounded time or memory, or reaches outside the delivery."""


class RuleError(FoparqError):
    """A rule breaks the conventions of the house: a programming error."""


class WriteError(FoparqError):
    """A result cannot be written."""
