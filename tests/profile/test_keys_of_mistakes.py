# SPDX-License-Identifier: MIT
"""The key and the line that a mistake in a manifest is told with are those that were written."""

from pathlib import Path

import pytest

from foparq.errors import ManifestError
from foparq.profile.load import load_manifest


@pytest.mark.parametrize(
    ("text", "message", "line", "key"),
    [
        ('[[drawing]]\npath = "a"\nplane = [[0, 0], [1, 0]]\n', "toml.wrong-value", 3, "plane"),
        ('[[drawing]]\npath = "a"\nplane = 3\n', "toml.wrong-value", 3, "plane"),
        ('[[drawing]]\npath = "a"\nplane = { x = 1 }\n', "toml.wrong-value", 3, "plane"),
        ('[[drawing]]\npath = "a"\nareas = "x"\n', "toml.wrong-value", 3, "areas"),
        ('[[drawing]]\npath = "a"\nareas = ["x", 3]\n', "toml.wrong-value", 3, "areas"),
        ('[[drawing]]\npath = "a"\n\n[[drawing]]\npath = "b"\nclasses = { A = 3 }\n', "toml.wrong-value", 6, "A"),
        ('[[drawing]]\npath = "a"\nclasses = ["A"]\n', "toml.wrong-value", 3, "classes"),
        ("[delivery]\ntitle = 3\n", "toml.wrong-value", 2, "title"),
        ("\ndelivery = 3\n", "toml.wrong-value", 2, "delivery"),
        ("drawing = 3\n", "toml.wrong-value", 1, "drawing"),
        ("[delivery]\n\n[delivery.x]\ny = 1\n", "toml.unknown-key", 3, "x"),
        ('[checkpoints]\nunit = "mm"\n', "toml.missing-key", 1, "path"),
        ('[delivery]\n[[drawing]]\npath = "a"\n[[drawing]]\nfacade = "N"\n', "toml.missing-key", 4, "path"),
        (
            '[checkpoints]\npath = "p.csv"\nsurvey_sd = "0.3 mm @ scale"\n',
            "quantity.on-sheet-at",
            3,
            "checkpoints.survey_sd",
        ),
        (
            '[checkpoints]\npath = "p.csv"\nsurvey_sd = "-0.3 mm"\n',
            "quantity.not-positive-at",
            3,
            "checkpoints.survey_sd",
        ),
        ('[distances]\npath = "p.csv"\nsurvey_sd = "0 mm"\n', "quantity.not-positive-at", 3, "distances.survey_sd"),
    ],
)
def test_a_mistake_is_told_with_its_own_key_and_line(
    tmp_path: Path, text: str, message: str, line: int, key: str
) -> None:
    path = tmp_path / "delivery.toml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(ManifestError) as caught:
        load_manifest(path)
    assert (caught.value.message, caught.value.fields["line"], caught.value.fields["key"]) == (message, line, key)


@pytest.mark.parametrize(
    ("text", "known"),
    [
        ("[delivery]\nx = 1\n", ["crs", "language", "profile", "scale", "title"]),
        ("[features]\npath = 'f.csv'\nx = 1\n", ["path", "sheet", "spacing"]),
        ("[checkpoints]\npath = 'f.csv'\nx = 1\n", ["path", "sheet", "survey_sd", "unit"]),
    ],
)
def test_an_unknown_key_is_told_with_those_that_its_table_knows(tmp_path: Path, text: str, known: list[str]) -> None:
    path = tmp_path / "delivery.toml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(ManifestError) as caught:
        load_manifest(path)
    assert caught.value.fields["example"].split(", ") == known
