# SPDX-License-Identifier: MIT
"""What people confirm by name must be something that the manifest states."""

import pytest

from foparq.errors import ManifestError
from foparq.profile.manifest import Manifest
from foparq.read.statements import confirmed, confirms


def manifest(what: str, value: str, path: str = "") -> Manifest:
    drawings = [{"path": "a.dxf", "unit": "mm", "plane": "xz"}, {"path": "b.dxf", "unit": "m", "facade": "Sul"}]
    one = {"what": what, "value": value, "by": "a name", "reason": "a reason", "path": path}
    return Manifest.model_validate({"drawing": drawings, "confirmed": [one]}) if what else Manifest()


@pytest.mark.parametrize(
    ("what", "value", "path", "files"),
    [
        ("unit", "mm", "", ["a.dxf"]), ("unit", "m", "", ["b.dxf"]), ("unit", "m", "b.dxf", ["b.dxf"]),
        ("plane", "XZ", "", ["a.dxf"]), ("scale", "1:500", "", []), ("checkpoints", "not drawn", "", []),
        ("distances", "Not drawn", "", []), ("facade", "SUL", "", []),
    ],
)  # fmt: skip
def test_what_is_stated_can_be_confirmed(what: str, value: str, path: str, files: list[str]) -> None:
    made = manifest(what, value, path)
    (one,) = confirmed(made, "delivery.toml")
    assert (one.what, one.value, one.by, one.reason) == (what, value, "a name", "a reason")
    assert [section.path for section in made.drawing if confirms(made.confirmed[0], section)] == files


@pytest.mark.parametrize(
    ("what", "value", "path", "example"),
    [
        ("unit", "km", "", 'value = "mm", value = "m"'), ("unit", "m", "a.dxf", 'value = "mm"'),
        ("plane", "xy", "", 'value = "xz"'), ("plane", "xy", "b.dxf", 'plane = "xy"'),
        ("checkpoints", "yes", "", 'value = "not drawn"'), ("facade", "N", "", 'value = "Sul"'),
    ],
)  # fmt: skip
def test_a_slip_is_told_with_what_would_be_right(what: str, value: str, path: str, example: str) -> None:
    with pytest.raises(ManifestError) as caught:
        confirmed(manifest(what, value, path), "delivery.toml")
    assert caught.value.fields["example"] == example
    assert caught.value.fields["key"] == f"confirmed.{what}"


def test_a_plane_of_axes_is_confirmed_as_given() -> None:
    drawing = {"path": "a.dxf", "plane": [[0, 0, 0], [0.6, 0.8, 0], [0, 0, 1]]}
    one = {"what": "plane", "value": "Given", "by": "a name", "reason": "a reason"}
    made = Manifest.model_validate({"drawing": [drawing], "confirmed": [one]})
    confirmed(made, "delivery.toml")
    assert confirms(made.confirmed[0], made.drawing[0])
