# SPDX-License-Identifier: MIT
"""glTF 2.0 and GLB: triangles, strips and fans of the scene that is shown at first, in metres, y up.

The mesh of a node stands once for every node that shows it, transformed in double precision; where a transformation
mirrors, the corners are turned round, as the format says. Primitives of one node that share their vertices share them
here. Texture coordinates are as written: v goes down. Compressed data are refused. Each node is a group, by its name or
that of its mesh.
"""

from foparq.errors import UnreadableError
from foparq.model.drawing import Repair
from foparq.model.mesh import RawMesh
from foparq.read.mesh.gltf_data import Buffers
from foparq.read.mesh.gltf_json import Part, parsed
from foparq.read.mesh.gltf_nodes import placed_nodes
from foparq.read.mesh.gltf_surface import Surface
from foparq.read.mesh.made import Delivered

_HEADER, _CHUNK = 12, 8  #: bytes
_JSON, _BIN = b"JSON", b"BIN\0"
#: extensions that a reader of surfaces may leave aside, or that are read
_HARMLESS = ("KHR_materials_", "KHR_texture_", "EXT_texture_", "KHR_lights_", "KHR_mesh_quantization", "KHR_xmp")
_COMPRESSED = ("draco", "meshopt", "compression")


def read_gltf(delivered: Delivered) -> RawMesh:
    """Mesh of a glTF file in text; its buffers are in it, or files in its folder.

    Raises
    ------
    UnreadableError
        If the text is no JSON, a value is of the wrong kind, an accessor reaches out of its buffer, a buffer is not
        there, data are compressed, or nodes are no tree.
    UnsafeError
        If it holds more vertices or faces than the limits allow, or names a file outside its folder.

    Notes
    -----
    O(n), of the vertices and faces of all nodes.
    """
    return _read(delivered, parsed(delivered.data, delivered.name), None, "glTF", ())


def read_glb(delivered: Delivered) -> RawMesh:
    """Mesh of a GLB file: as :func:`read_gltf`."""
    data = delivered.data
    version, length = (int.from_bytes(data[at : at + 4], "little") for at in (4, 8))
    if version != 2:  # noqa: PLR2004 - of the format
        raise UnreadableError("mesh.gltf-version", file=delivered.name, value=version)
    delivered.hold_bytes("GLB", length, length, 0)
    repairs: tuple[Repair, ...] = ()
    if len(data) > length:
        if data[length:].strip(b"\0\t\n\r \x1a"):
            raise UnreadableError("mesh.trailing", file=delivered.name, byte=length, value=len(data) - length)
        repairs = (Repair(code="mesh-trailing-bytes", text=str(len(data) - length)),)
    chunks = _chunks(delivered, length)
    if not chunks or chunks[0][0] != _JSON:
        raise UnreadableError("mesh.header-lacks", file=delivered.name, value="JSON", example="glTF 2 ... JSON")
    # The second chunk is the buffer, if it is one; others are of extensions.
    inner = chunks[1][1] if len(chunks) > 1 and chunks[1][0] == _BIN else None
    return _read(delivered, parsed(chunks[0][1], delivered.name), inner, "GLB", repairs)


def _chunks(delivered: Delivered, end: int) -> list[tuple[bytes, bytes]]:
    """Kind and bytes of the first two chunks."""
    found, at = list[tuple[bytes, bytes]](), _HEADER
    while at < end and len(found) < 2:  # noqa: PLR2004 - text and buffer
        size = int.from_bytes(delivered.data[at : at + 4], "little")
        delivered.hold_bytes("GLB", size, size, at + _CHUNK)
        found.append((delivered.data[at + 4 : at + _CHUNK], delivered.data[at + _CHUNK : at + _CHUNK + size]))
        at += _CHUNK + size
    return found


def _read(delivered: Delivered, document: Part, inner: bytes | None, name: str, repairs: tuple[Repair, ...]) -> RawMesh:
    if not document.has("asset"):
        raise UnreadableError("mesh.not-a-mesh", file=delivered.name, value="JSON")
    version = document.part("asset").text("version")
    if not version.startswith("2."):
        raise UnreadableError("mesh.gltf-version", file=delivered.name, value=version or "-")
    _hold_extensions(document)
    surface = Surface(delivered, document, Buffers(delivered, document, inner))
    nodes, left = placed_nodes(document)
    for placed in nodes:
        if _instanced(placed.node):
            raise UnreadableError("mesh.gltf-extension", file=delivered.name, value="EXT_mesh_gpu_instancing")
        for key in ("camera", "skin"):
            if placed.node.has(key):
                surface.tell(key)
    surface.add(nodes)
    if left:
        surface.tell("node", left)
    if animations := document.list_of("animations"):
        surface.tell("animation", len(animations))
    return surface.made(f"{name} {version}", repairs)


def _instanced(node: Part) -> bool:
    return node.part("extensions").has("EXT_mesh_gpu_instancing")


def _hold_extensions(document: Part) -> None:
    """Refuse what changes geometry and is not understood."""
    for key, wanted in (("extensionsUsed", _is_compressed), ("extensionsRequired", _is_strange)):
        for name in document.list_of(key):
            if not isinstance(name, str):
                raise document.wrong(key, '["KHR_materials_unlit"]')
            if wanted(name):
                message = "mesh.gltf-compressed" if _is_compressed(name) else "mesh.gltf-extension"
                raise UnreadableError(message, file=document.file, value=name[:80])


def _is_compressed(name: str) -> bool:
    return any(word in name.lower() for word in _COMPRESSED)


def _is_strange(name: str) -> bool:
    return not name.startswith(_HARMLESS)
