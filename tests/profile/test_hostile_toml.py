# SPDX-License-Identifier: MIT
"""A manifest that means harm is refused in a sentence, at once."""

import os
from pathlib import Path

import pytest

from foparq.errors import ManifestError, UsageError
from foparq.profile.load import load_manifest, load_profile
from foparq.profile.toml_text import read_toml
from foparq.report.words import LANGUAGES, Words

DRAWING = '[delivery]\nscale = "1:50"\n[[drawing]]\npath = "a.dxf"\n'

HOSTILE = {
    "open brackets": "[delivery]\ntitle = " + "[" * 100_000,
    "closed brackets": "[record]\na = " + "[" * 100_000 + "]" * 100_000,
    "brackets within Python's own limit": "[record]\na = " + "[" * 100 + "]" * 100,
    "inline tables": "[record]\na = " + "{a=" * 50_000 + "1" + "}" * 50_000,
    "a chain of tables": "[record" + ".a" * 400_000 + "]\n",
    "a chain of quoted keys": "[record]\n" + '"a".' * 200_000 + "a = 1\n",
    "a chain within braces": "[record]\nx = { " + "a . " * 200_000 + "a = 1 }\n",
    "an integer of 6,000 digits": "[record]\na = " + "9" * 6_000,
    "a scale of 5,000 digits": '[delivery]\nscale = "1:' + "9" * 5_000 + '"\n',
    "a value without quotes": "[delivery]\nscale = " + "x" * 5_000,
    "a plane that is nan": DRAWING + "plane = [[nan,0,0],[1,0,0],[0,0,1]]",
    "a plane that is infinite": DRAWING + "plane = [[0,0,0],[inf,0,0],[0,0,1]]",
    "a plane larger than the planet": DRAWING + "plane = [[0,0,0],[1e300,0,0],[0,0,1]]",
    "a NUL": '[delivery]\ntitle = "a\0b"\n',
}


@pytest.mark.parametrize("text", HOSTILE.values(), ids=HOSTILE)
def test_a_hostile_manifest_is_refused_in_a_short_sentence(text: str, tmp_path: Path) -> None:
    path = tmp_path / "delivery.toml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(UsageError) as caught:
        load_manifest(path)
    for language in LANGUAGES:
        told = Words(language).error(caught.value)
        assert str(path) in told
        assert "{" not in told.replace("plane = {", "")


@pytest.mark.parametrize("encoding", ["utf-16", "utf-16-be", "cp1252"])
def test_another_encoding_is_named(encoding: str, tmp_path: Path) -> None:
    path = tmp_path / "delivery.toml"
    path.write_bytes('[delivery]\ntitle = "Estação"\n'.encode(encoding))
    with pytest.raises(ManifestError) as caught:
        load_manifest(path)
    assert caught.value.message in {"toml.not-utf8", "toml.syntax"}


def test_a_mark_at_the_beginning_is_no_fault(tmp_path: Path) -> None:
    path = tmp_path / "delivery.toml"
    path.write_bytes(b'\xef\xbb\xbf[delivery]\ntitle = "x"\n')
    assert load_manifest(path).delivery.title == "x"


@pytest.mark.parametrize("depth", [30, 31])
def test_lists_within_lists_are_taken_up_to_a_depth(depth: int, tmp_path: Path) -> None:
    # The file, [record] and the lists.
    path = tmp_path / "delivery.toml"
    path.write_text("[record]\na = " + "[" * (depth - 1) + "]" * (depth - 1), encoding="utf-8")
    assert read_toml(path, ManifestError).data["record"]


def test_dotted_words_of_a_text_are_no_chain(tmp_path: Path) -> None:
    path = tmp_path / "delivery.toml"
    path.write_text('[record]\na = """' + "Uma frase. " * 100 + "." * 500 + '"""\n', encoding="utf-8")
    assert load_manifest(path).record


def test_a_pipe_is_never_waited_for(tmp_path: Path) -> None:
    path = tmp_path / "delivery.toml"
    os.mkfifo(path)
    with pytest.raises(ManifestError) as caught:
        load_manifest(path)
    assert caught.value.message == "toml.not-a-file"


def test_a_profile_that_no_file_system_could_hold(tmp_path: Path) -> None:
    for name in ("x" * 5_000, "x" * 5_000 + ".toml", "x/" * 3_000 + ".toml"):
        with pytest.raises(UsageError) as caught:
            load_profile(name, tmp_path)
        assert caught.value.message == "profile.unknown"
        assert len(Words("en").error(caught.value)) < 500
