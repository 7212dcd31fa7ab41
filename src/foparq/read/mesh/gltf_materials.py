# SPDX-License-Identifier: MIT
"""Materials of a glTF file, and the image that each shows as its colour."""

from dataclasses import dataclass
from urllib.parse import unquote

from foparq.read.mesh.gltf_json import Part


@dataclass(frozen=True, slots=True)
class Material:
    """One material."""

    name: str
    image: str  #: as written; ``"data:image/png"`` for one that the file holds itself; ``""`` if there is none
    set: int  #: which texture coordinates it takes


def materials_of(document: Part) -> list[Material]:
    """Materials in the order of the file.

    Raises
    ------
    UnreadableError
        If one names a texture or an image that is not there.
    """
    return [_material(document, material) for material in document.parts("materials")]


def _material(document: Part, material: Part) -> Material:
    colour = material.part("pbrMetallicRoughness").part("baseColorTexture")
    if not colour.has("index"):
        return Material(material.text("name"), "", 0)
    texture = document.at("textures", colour.whole("index"))
    return Material(material.text("name"), _shown_by(document, texture), colour.whole("texCoord", 0))


def _shown_by(document: Part, texture: Part) -> str:
    """Image of a texture; an extension may name one in another format."""
    if texture.has("source"):
        return image_of(document.at("images", texture.whole("source")))
    extensions = texture.part("extensions")
    for name in extensions.said:
        if extensions.part(name).has("source"):
            return image_of(document.at("images", extensions.part(name).whole("source")))
    return ""


def image_of(image: Part) -> str:
    """Name of an image: its file, or ``"data:"`` and its kind where the file holds it itself."""
    address = image.text("uri")
    if address and not address.lower().startswith("data:"):
        return unquote(address)
    kind = image.text("mimeType") or address[5:].partition(";")[0].partition(",")[0]
    return f"data:{kind}"
