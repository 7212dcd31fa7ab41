# SPDX-License-Identifier: MIT
"""Nodes of a glTF scene, and where each stands: transformations are multiplied in double precision."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from foparq.errors import UnreadableError
from foparq.read.mesh.gltf_json import Part

Matrix = NDArray[np.float64]  #: (4, 4)


@dataclass(frozen=True, slots=True)
class Placed:
    """A node of the scene."""

    node: Part
    matrix: Matrix | None  #: from the node to the scene; ``None`` if nothing moves


def placed_nodes(document: Part) -> tuple[list[Placed], int]:
    """Nodes of the scene that is shown at first, depth first, and how many with a mesh it leaves out.

    Raises
    ------
    UnreadableError
        If a node is its own ancestor, or stands in two places, which the format forbids.

    Notes
    -----
    O(n), without recursion: nodes may be nested as deep as the file likes.
    """
    count = len(document.list_of("nodes"))
    seen = np.zeros(count, dtype=bool)
    waiting: list[tuple[int, Matrix | None]] = [(root, None) for root in reversed(_roots(document, count))]
    found = []
    while waiting:
        number, above = waiting.pop()
        node = document.at("nodes", number)
        if seen[number]:
            raise UnreadableError("mesh.gltf-nodes", file=document.file, key=node.path)
        seen[number] = True
        matrix = _product(above, _matrix(node))
        found.append(Placed(node, matrix))
        waiting += [(child, matrix) for child in reversed(node.wholes("children"))]
    left = sum(node.has("mesh") for node, read in zip(document.parts("nodes"), seen.tolist(), strict=True) if not read)
    return found, left


def _roots(document: Part, count: int) -> list[int]:
    if document.list_of("scenes"):
        return document.at("scenes", document.whole("scene", 0)).wholes("nodes")
    children = {child for node in document.parts("nodes") for child in node.wholes("children")}
    roots = [number for number in range(count) if number not in children]
    if count and not roots:
        raise UnreadableError("mesh.gltf-nodes", file=document.file, key="nodes[0]")
    return roots


def _product(above: Matrix | None, own: Matrix | None) -> Matrix | None:
    if above is None or own is None:
        return own if above is None else above
    with np.errstate(over="ignore", invalid="ignore"):
        product: Matrix = above @ own
    return product


def _matrix(node: Part) -> Matrix | None:
    """Transformation of a node: its matrix, or else translation, rotation and scale."""
    columns = node.reals("matrix", 16)
    if columns is not None:
        return np.array(columns).reshape(4, 4).T
    shift, turn, scale = node.reals("translation", 3), node.reals("rotation", 4), node.reals("scale", 3)
    if shift is None and turn is None and scale is None:
        return None
    matrix = np.eye(4)
    with np.errstate(over="ignore", invalid="ignore"):
        matrix[:3, :3] = _rotation(*(turn or (0.0, 0.0, 0.0, 1.0))) * np.array(scale or (1.0, 1.0, 1.0))
    matrix[:3, 3] = shift or (0.0, 0.0, 0.0)
    return matrix


def _rotation(*quaternion: float) -> NDArray[Any]:
    """(3, 3) rotation of a unit quaternion x, y, z, w."""
    x, y, z, w = np.array(quaternion)
    return np.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ])  # fmt: skip
