# SPDX-License-Identifier: MIT
"""glTF files written plainly: a value after the other into one buffer."""

import base64
import json
import struct
from collections.abc import Sequence
from typing import Any

CODES = {5120: "b", 5121: "B", 5122: "h", 5123: "H", 5125: "I", 5126: "f"}
KINDS = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4"}


class Gltf:
    """A document, and its buffer."""

    def __init__(self) -> None:
        self.document: dict[str, Any] = {"asset": {"version": "2.0"}, "bufferViews": [], "accessors": []}
        self.data = b""

    def view(self, data: bytes, **said: Any) -> int:
        """Number of a new buffer view."""
        self.document["bufferViews"].append(
            {"buffer": 0, "byteOffset": len(self.data), "byteLength": len(data), **said}
        )
        self.data += data
        return len(self.document["bufferViews"]) - 1

    def accessor(self, rows: Sequence[Sequence[float]], kind: int = 5126, *, stride: int = 0, **said: Any) -> int:
        """Number of a new accessor, in a view of its own."""
        packed = [struct.pack(f"<{len(row)}{CODES[kind]}", *row) for row in rows]
        view = self.view(
            b"".join(row.ljust(stride, b"\xee") for row in packed), **({"byteStride": stride} if stride else {})
        )
        width = len(rows[0])
        self.document["accessors"].append(
            {"bufferView": view, "componentType": kind, "type": KINDS[width], "count": len(rows), **said}
        )
        return len(self.document["accessors"]) - 1

    def mesh(self, *primitives: dict[str, Any], **said: Any) -> int:
        """Number of a new mesh."""
        self.document.setdefault("meshes", []).append({"primitives": list(primitives), **said})
        return len(self.document["meshes"]) - 1

    def nodes(self, *nodes: dict[str, Any], roots: Sequence[int] | None = None) -> None:
        """Nodes, and a scene of those that are named."""
        self.document = {key: value for key, value in self.document.items() if key not in ("scene", "scenes")}
        self.document["nodes"] = list(nodes)
        if roots is not None:
            self.document |= {"scene": 0, "scenes": [{"nodes": list(roots)}]}

    def glb(self) -> bytes:
        """As one binary file."""
        document = {**self.document, "buffers": [{"byteLength": len(self.data)}]}
        text = json.dumps(document).encode()
        text += b" " * (-len(text) % 4)
        inner = self.data + b"\0" * (-len(self.data) % 4)
        chunks = struct.pack("<I", len(text)) + b"JSON" + text + struct.pack("<I", len(inner)) + b"BIN\0" + inner
        return b"glTF" + struct.pack("<II", 2, 12 + len(chunks)) + chunks

    def text(self, uri: str | None = None) -> bytes:
        """As text, with its buffer within, or in a file."""
        coded = "data:application/octet-stream;base64," + base64.b64encode(self.data).decode()
        buffer = {"byteLength": len(self.data), "uri": coded if uri is None else uri}
        return json.dumps({**self.document, "buffers": [buffer]}).encode()


def pyramid(points: Sequence[Sequence[float]], faces: Sequence[Sequence[int]], kind: int = 5123) -> Gltf:
    """One mesh in one node."""
    made = Gltf()
    position = made.accessor(points)
    indices = made.accessor([(vertex,) for face in faces for vertex in face], kind)
    made.mesh({"attributes": {"POSITION": position}, "indices": indices})
    made.nodes({"mesh": 0, "name": "torre"}, roots=[0])
    return made
