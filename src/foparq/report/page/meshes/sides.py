# SPDX-License-Identifier: MIT
"""From where a mesh is looked at: six sides, and which axis is up."""

import numpy as np

from foparq.columns import Reals
from foparq.model.mesh import Mesh

SIDES = ("front", "back", "left", "right", "top", "bottom")
#: axis to the right and axis up, seen from the front; the viewer stands before, right x up
_FRAMES = {"z": ((1, 0, 0), (0, 0, 1)), "y": ((1, 0, 0), (0, 1, 0)), "x": ((0, 1, 0), (1, 0, 0))}


def up_of(mesh: Mesh) -> str:
    """Axis that is drawn upward: as stated, else as the format says, else z."""
    return mesh.up or (mesh.reading.up if mesh.reading.up in _FRAMES else "") or "z"


def frame_of(up: str) -> Reals:
    """(3, 3) rows: right, up, and towards the viewer who stands in front, as axes of the file.

    With z up it is that of a drawing in the plane xz: the view is towards +y. With y up it is that of glTF, which looks
    towards -z.

    Examples
    --------
    >>> frame_of("z").tolist()
    [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]]
    """
    right, upward = np.array(_FRAMES[up], dtype=float)
    return np.stack([right, upward, np.cross(right, upward)]) + 0.0  # no negative zeros


def side_frame(up: str, side: str) -> Reals:
    """(3, 3) rows: right, up, and towards the viewer who looks at a side.

    From top and bottom the right side stays on the right.
    """
    right, upward, back = frame_of(up)
    rows = {
        "front": (right, upward, back),
        "back": (-right, upward, -back),
        "left": (back, upward, -right),
        "right": (-back, upward, right),
        "top": (right, -back, upward),
        "bottom": (right, back, -upward),
    }[side]
    return np.stack(rows) + 0.0
