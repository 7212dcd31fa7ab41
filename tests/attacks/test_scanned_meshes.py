# SPDX-License-Identifier: MIT
"""Deliveries of a mesh with a reference: what it shows stands beside the verdict, and what it cannot show is said."""

import json
import re
from pathlib import Path
from typing import Any

import jsonschema
import numpy as np
import pytest
from lxml import etree
from tests.attacks.mesh_deliveries import sound_drawing
from tests.attacks.meshes import write_ply
from tests.attacks.surveyed_meshes import Answer, Delivery, head, triangles, without, write
from tests.mesh.files import Mesh
from tests.read.cloud.files import las, ply
from tests.tools.sound import unguarded

from foparq.audit import audit, audit_to
from foparq.cli.main import run
from foparq.columns import Coordinates
from foparq.errors import ManifestError
from foparq.evaluate.quality import ElementStatus
from foparq.model.delivery import SourceStatus
from foparq.model.drawing import SkippedReason
from foparq.profile.load import load_manifest
from foparq.report.sentences import reason_sentence
from foparq.report.words import Words

FAR = np.array([712345.678, 7456789.123, 812.5])
LIMIT = 0.003  #: of Q1 at 1:10, metres; a point is covered within 10 mm
REFERENCE = '[[reference]]\npath = "nuvem.xyz"\nunit = "m"\nsurvey_sd = "0.5 mm"\n'


def scan(of: Mesh, n: int = 6000, noise: float = 0.0005, seed: int = 7) -> Coordinates:
    """Places over a surface, as many on equal areas, with noise along every axis."""
    rng, corners = np.random.default_rng(seed), triangles(of)
    area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    rows = rng.choice(len(corners), n, p=area / area.sum())
    places = np.einsum("ij,ijk->ik", rng.dirichlet([1.0, 1.0, 1.0], n), corners[rows])
    scanned: Coordinates = places + rng.normal(0, noise, places.shape)
    return scanned


def deliver(folder: Path, cloud: Coordinates | None, *, more: str = REFERENCE, **made: Any) -> Answer:
    """What is said of a delivery that is sound but for what is stated, with a reference."""
    write(Delivery(more=more, **made), folder)
    if cloud is not None:
        np.savetxt(folder / "nuvem.xyz", cloud, fmt="%.6f")
    with unguarded():
        return Answer(audit(folder).record)


def why(found: Answer, element: str = "C2M") -> str:
    words = Words("en")
    return "\n".join(reason_sentence(words, reason) for reason in found.element(element).why)


def parameters(found: Answer) -> dict[str, float]:
    return {name: value for name, value, _ in found.element("C2M").parameters}


@pytest.fixture(scope="module")
def sound(tmp_path_factory: pytest.TempPathFactory) -> Answer:
    return deliver(tmp_path_factory.mktemp("sound") / "d", scan(head()))


def test_a_sound_delivery_is_accepted_and_its_distances_are_reported(sound: Answer) -> None:
    assert sound.verdict == "accepted", sound.why
    told = sound.element("C2M")
    assert (told.status, told.required, told.n) == (ElementStatus.REPORTED, False, 6000)
    # Of noise along three axes the surface shows the part across it.
    assert told.value == pytest.approx(0.0005, rel=0.1)
    assert parameters(sound)["detectable"] == pytest.approx(1.96 * 0.0005)
    assert parameters(sound)["share-uncovered"] == 0
    assert parameters(sound)["beyond"] == pytest.approx(LIMIT)
    assert "is below the limit of Q1" in why(sound)
    (source,) = [one for one in sound.record.delivery.sources if one.role == "reference"]
    assert (source.path, source.status, source.items, len(source.sha256)) == ("nuvem.xyz", SourceStatus.READ, 6000, 64)
    assert "C2M" in sound.why, "an acceptance names what is not required"


def test_a_delivery_without_reference_has_no_such_element(tmp_path: Path) -> None:
    found = deliver(tmp_path / "d", None, more="")
    assert "C2M" not in {one.id for one in found.record.quality.elements}


def test_a_reference_is_a_comparison_of_size_and_place(tmp_path: Path) -> None:
    said = "not compared with surveyed points"
    assert said in why(deliver(tmp_path / "a", None, more="", tables=()), "Q3-mesh")
    assert said not in why(deliver(tmp_path / "b", scan(head()), tables=()), "Q3-mesh")
    for name, points in {"far": scan(head()) + 40.0, "same": head().points, "none": scan(head())[:2]}.items():
        assert said in why(deliver(tmp_path / name, points, tables=()), "Q3-mesh"), name


def test_a_cloud_of_something_else_is_told_and_decides_nothing(tmp_path: Path) -> None:
    for name, points in {"moved": scan(head()) + 40.0, "millimetres": scan(head()) * 1000}.items():
        found = deliver(tmp_path / name, points)
        assert found.element("C2M").status is ElementStatus.UNDECIDED
        assert "speaks of something else" in why(found)
        assert "speaks of something else" in why(found, "Q3-mesh")
        assert found.verdict == "accepted"
        assert not re.search("may be missing", found.why)


def test_a_surface_that_is_too_large_is_measured(tmp_path: Path) -> None:
    grown = deliver(tmp_path / "d", scan(head()), points=lambda points: points * 1.05)
    told = grown.element("C2M")
    assert told.status is ElementStatus.REPORTED
    assert told.value is not None
    assert told.value > 2 * LIMIT
    assert "reaches the limit of Q1" in why(grown)


def test_what_the_mesh_lacks_is_a_remark_of_omission_and_no_rate(tmp_path: Path) -> None:
    whole = head()
    low = triangles(whole).mean(axis=1)[:, 2]
    lacking = without(whole, np.flatnonzero(low > np.quantile(low, 0.5)))
    points = scan(whole)
    found = deliver(tmp_path / "d", points, surface=lambda: lacking)
    rim = points[:, 2] > np.quantile(low, 0.5) + 0.03
    share = parameters(found)["share-uncovered"]
    assert rim.mean() - 0.02 < share < np.mean(points[:, 2] > np.quantile(low, 0.5)) + 0.02
    remark = next(line for line in why(found, "Q5").split("\n") if "may be missing" in line)
    assert "nuvem.xyz" in remark
    assert "lie together near" in remark
    assert remark in found.why
    with_list = deliver(tmp_path / "e", None, more="", surface=lambda: lacking)
    assert found.element("Q5").value == with_list.element("Q5").value


def test_the_own_vertices_of_the_mesh_show_nothing(tmp_path: Path) -> None:
    found = deliver(tmp_path / "d", head().points)
    assert found.element("C2M").status is ElementStatus.UNDECIDED
    assert "shows nothing that was measured apart" in why(found)


@pytest.mark.parametrize("what", ["absent", "letters", "empty", "no unit"])
def test_a_reference_of_which_nothing_is_known_leaves_the_element_open(what: str, tmp_path: Path) -> None:
    more = REFERENCE.replace('unit = "m"\n', "") if what == "no unit" else REFERENCE
    folder = write(Delivery(more=more), tmp_path / "d")
    if what != "absent":
        text = {"letters": "1 2 three\n", "empty": "", "no unit": "1 2 3\n"}[what]
        (folder / "nuvem.xyz").write_text(text, encoding="utf-8")
    with unguarded():
        found = Answer(audit(folder).record)
    assert found.element("C2M").status is ElementStatus.UNDECIDED
    assert found.verdict == ("accepted" if what == "no unit" else "undecided"), "a file that is named was read, or not"
    assert ("nobody states the unit" if what == "no unit" else "could not be read") in why(found)


def test_a_mesh_that_could_not_be_read_leaves_nothing_to_compare_with(tmp_path: Path) -> None:
    folder = write(Delivery(more=REFERENCE), tmp_path / "d")
    np.savetxt(folder / "nuvem.xyz", scan(head(), 50))
    (folder / "busto.ply").write_bytes(b"ply\n")
    with unguarded():
        found = Answer(audit(folder).record)
    assert "was compared with nothing" in why(found)
    assert found.element("C2M").status is ElementStatus.UNDECIDED


def test_points_without_coordinates_are_told_and_change_no_number(sound: Answer, tmp_path: Path) -> None:
    points = np.insert(scan(head()), [0, 3000], np.nan, axis=0)
    found = deliver(tmp_path / "d", points)
    (source,) = [one for one in found.record.delivery.sources if one.role == "reference"]
    assert [(one.reason, one.count) for one in source.skipped] == [(SkippedReason.NO_COORDINATES, 2)]
    assert parameters(found) == parameters(sound)
    assert found.verdict == "accepted"


@pytest.mark.parametrize("name", ["nuvem.ply", "nuvem.las", "nuvem.laz"])
def test_every_format_in_a_grid_in_millimetres_within_the_guards(sound: Answer, name: str, tmp_path: Path) -> None:
    more = REFERENCE.replace("nuvem.xyz", name).replace('unit = "m"', 'unit = "mm"')
    folder = write(Delivery(more=more, points=lambda points: points + FAR, tables=()), tmp_path / "d")
    points = (scan(head()) + FAR) * 1000
    if name.endswith("ply"):
        (folder / name).write_bytes(ply(points))
    else:
        las(folder / name, points)
    found = Answer(audit(folder).record)
    told = found.element("C2M")
    assert (told.status, told.n) == (ElementStatus.REPORTED, 6000)
    assert told.value == pytest.approx(sound.element("C2M").value, rel=1e-3)


def test_a_reference_names_a_mesh_of_the_manifest(tmp_path: Path) -> None:
    named = deliver(tmp_path / "a", scan(head()), more=REFERENCE + 'mesh = "Busto.PLY"\n')
    assert named.element("C2M").status is ElementStatus.REPORTED
    with pytest.raises(ManifestError) as caught:
        deliver(tmp_path / "b", scan(head()), more=REFERENCE + 'mesh = "outra.ply"\n')
    for language in ("pt-BR", "en"):
        assert "busto.ply" in Words(language).error(caught.value)


def test_a_mesh_is_no_reference_of_itself(tmp_path: Path) -> None:
    with pytest.raises(ManifestError):
        deliver(tmp_path / "d", None, more='[[reference]]\npath = "busto.ply"\nunit = "m"\n')


def test_a_cloud_that_is_not_named_is_listed(tmp_path: Path) -> None:
    found = deliver(tmp_path / "d", scan(head()), more="")
    assert [one.path for one in found.record.delivery.sources if one.status is SourceStatus.UNNAMED] == ["nuvem.xyz"]


@pytest.mark.parametrize("language", ["pt-BR", "en"])
def test_every_report_tells_of_it(language: str, tmp_path: Path, repository: Path) -> None:
    folder = write(Delivery(more=REFERENCE), tmp_path / "d")
    np.savetxt(folder / "nuvem.xyz", np.concatenate([scan(head(), 900), np.full((100, 3), 2.0)]), fmt="%.6f")
    with unguarded():
        written = audit_to(folder, language=language)
    assert not written.log
    told = json.loads((folder / "audit" / "audit.json").read_text(encoding="utf-8"))
    schema = json.loads((repository / "reports/templates/schema/foparq-audit-1.schema.json").read_text("utf-8"))
    jsonschema.validate(told, schema)
    (one,) = told["references"]
    assert (one["reference"], one["meshes"], one["n"], one["uncovered"]["n"]) == ("nuvem.xyz", ["busto.ply"], 1000, 100)
    assert one["worst"][0]["where"] == one["uncovered"]["where"] == [2.0, 2.0, 2.0]
    assert sum(one["histogram"]["counts"]) == 1000
    page = (folder / "audit" / "report.html").read_text(encoding="utf-8")
    assert page.count('class="histogram"') == 2, "once in each language"
    assert "nuvem.xyz" in page
    quality = etree.parse(folder / "audit" / "quality.xml")
    assert "cloud-to-mesh" in etree.tostring(quality, encoding="unicode")


@pytest.mark.parametrize("name", ["nuvem.xyz", "nuvem.laz", "nuvem.ply", "nuvem.csv"])
def test_init_proposes_a_reference_that_the_audit_takes(name: str, tmp_path: Path) -> None:
    folder = write(Delivery(tables=()), tmp_path / "d")
    (folder / "delivery.toml").unlink()
    points = scan(head(), 1500)
    if name.endswith("laz"):
        las(folder / name, points)
    elif name.endswith("ply"):
        (folder / name).write_bytes(ply(points))
    else:
        np.savetxt(folder / name, points, fmt="%.6f", delimiter="," if name.endswith("csv") else " ")
    assert run(["init", str(folder)]) == 0
    manifest = load_manifest(folder / "delivery.toml")
    assert [one.path for one in manifest.reference] == [name]
    assert [one.path for one in manifest.mesh] == ["busto.ply"]


def test_init_takes_notes_and_short_tables_for_no_cloud(tmp_path: Path) -> None:
    folder = write(Delivery(tables=()), tmp_path / "d")
    (folder / "delivery.toml").unlink()
    (folder / "leia-me.txt").write_text("Levantamento de março.\n", encoding="utf-8")
    (folder / "numeros.txt").write_text("1 2 3\n" * 20, encoding="utf-8")
    assert run(["init", str(folder)]) == 0
    assert load_manifest(folder / "delivery.toml").reference == ()


def test_of_several_references_the_worst_one_is_the_value(tmp_path: Path) -> None:
    other = REFERENCE.replace("nuvem.xyz", "outra.xyz").replace("0.5 mm", "5 mm")
    for name, first, second in (("a", 0.002, 0.0005), ("b", 0.0005, 0.002)):
        folder = write(Delivery(more=REFERENCE + other), tmp_path / name)
        np.savetxt(folder / "nuvem.xyz", scan(head(), noise=first), fmt="%.6f")
        np.savetxt(folder / "outra.xyz", scan(head(), 3000, noise=second), fmt="%.6f")
        with unguarded():
            found = Answer(audit(folder).record)
        told = found.element("C2M")
        assert (told.value, told.n) == (pytest.approx(0.002, rel=0.1), 6000 if name == "a" else 3000)
        assert [one.path for one in found.record.quality.clouds] == ["nuvem.xyz", "outra.xyz"]
        coarse = [line for line in why(found).split("\n") if "are not known well enough" in line]
        assert len(coarse) == 1, "1.96 times 5 mm is more than the limit, 1.96 times 0.5 mm is not"
        assert "outra.xyz" in coarse[0]


def test_beside_drawings_omission_is_theirs(tmp_path: Path) -> None:
    folder = sound_drawing(tmp_path / "d")
    write_ply(head(), folder / "busto.ply")
    np.savetxt(folder / "nuvem.xyz", np.concatenate([scan(head()), np.full((50, 3), 2.0)]), fmt="%.6f")
    with (folder / "delivery.toml").open("a", encoding="utf-8") as manifest:
        manifest.write(f'\n[[mesh]]\npath = "busto.ply"\nunit = "m"\nclosed = false\n\n{REFERENCE}')
    with unguarded():
        found = Answer(audit(folder).record)
    assert found.element("C2M").status is ElementStatus.REPORTED
    assert "50) are farther than" in why(found)
    assert "may be missing" not in why(found, "Q5")
