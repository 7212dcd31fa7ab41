# SPDX-License-Identifier: MIT
"""Materials of an OBJ: which image each shows."""

from pathlib import Path

from foparq.errors import InputError
from foparq.read.guard.paths import fit_to_read, inside
from foparq.read.mesh.text import decoded

_LARGEST = 1 << 24  #: bytes
_MOST = 100_000  #: materials
#: options of an image, and how many words each takes
_OPTIONS = {
    "-blendu": 1, "-blendv": 1, "-boost": 1, "-bm": 1, "-cc": 1, "-clamp": 1, "-colorspace": 1, "-imfchan": 1,
    "-mm": 2, "-texres": 1, "-type": 1,
}  # fmt: skip
_UP_TO_THREE = frozenset({"-o", "-s", "-t"})


def images_of(folder: Path, named: str) -> dict[str, str] | None:
    """Image of each material of a library, by the name of the material; ``""`` where it shows none.

    Parameters
    ----------
    folder : Path
        Of the OBJ. Nothing outside is opened.
    named : str
        As the OBJ writes it.

    Returns
    -------
    dict or None
        ``None`` if the library is not there, lies outside, or is no text of sixteen megabytes at most.
    """
    try:
        path = inside(folder, named)
        fit_to_read(path, _LARGEST)
        text = path.read_bytes()
    except (InputError, OSError):
        return None
    if b"\0" in text:
        return None
    images: dict[str, str] = {}
    name = None
    for line in decoded(text).splitlines():
        words = line.split(None, 1)
        if len(words) < 2 or len(images) > _MOST:  # noqa: PLR2004 - a word and what it says
            continue
        if words[0].lower() == "newmtl":
            name = " ".join(words[1].split())
            images.setdefault(name, "")
        elif words[0].lower() == "map_kd" and name is not None:
            images[name] = image_of(words[1])
    return images


def image_of(said: str) -> str:
    """Name of the image in a statement ``map_Kd``, without its options.

    Examples
    --------
    >>> image_of("-s 1 1 1 -clamp on parede norte.jpg")
    'parede norte.jpg'
    """
    rest = said.strip()
    while rest.startswith("-"):
        word, _, behind = rest.partition(" ")
        word, behind = word.lower(), behind.lstrip()
        if word in _OPTIONS:
            for _ in range(_OPTIONS[word]):
                behind = behind.partition(" ")[2].lstrip()
        elif word in _UP_TO_THREE:
            for _ in range(3):
                first, _, after = behind.partition(" ")
                if not _is_number(first):
                    break
                behind = after.lstrip()
        else:
            break
        rest = behind
    return rest


def _is_number(word: str) -> bool:
    try:
        float(word)
    except ValueError:
        return False
    return True
