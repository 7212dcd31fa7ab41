# SPDX-License-Identifier: MIT
"""Where the files that travel with foparq are found."""

from pathlib import Path

_PACKAGE = Path(__file__).resolve().parent


def shipped(folder: str) -> Path:
    """Folder that travels with foparq: ``"rules"`` or ``"templates"``.

    Parameters
    ----------
    folder : str
        Name of the folder.

    Returns
    -------
    Path
        The packaged copy if foparq is installed, the repository's folder if it runs from a checkout.

    Raises
    ------
    FileNotFoundError
        If neither exists: the installation is broken.
    """
    packaged = _PACKAGE / "_shipped" / folder
    if packaged.is_dir():
        return packaged
    checkout = _PACKAGE.parents[1] / {"templates": "reports/templates"}.get(folder, folder)
    if checkout.is_dir():
        return checkout
    raise FileNotFoundError(f"foparq's own folder {folder!r} is missing from the installation")
