# SPDX-License-Identifier: MIT
"""``foparq init`` over what small offices keep in a folder: it proposes by the list, asks, and says why not."""

import re
import shutil
import tomllib
from pathlib import Path

import ezdxf
import openpyxl
import pytest
from tests.cli.conftest import Command
from tests.tools import office_files
from tests.tools.offices import office

from foparq.cli.init_names import class_like, facade_like
from foparq.profile.load import load_manifest
from foparq.read.table.revisions import is_aside, revision_of


def draw(path: Path, *layers: str) -> Path:
    document = ezdxf.new("R2010", units=6)
    for n, layer in enumerate(layers or ("0",)):
        document.modelspace().add_line((n, 0), (n + 1, 1), dxfattribs={"layer": layer})
    document.saveas(path)
    return path


def proposed(folder: Path) -> str:
    return (folder / "delivery.toml").read_text(encoding="utf-8")


@pytest.mark.parametrize("language", ["pt", "en"])
def test_layers_of_axes_and_dimensions_are_asked_about(foparq: Command, tmp_path: Path, language: str) -> None:
    layers = ("EIXO", "A-COTAS", "PAREDE", "EIXO_JANELA", "Cota h")
    draw(tmp_path / "fachada.dxf", *layers)
    (tmp_path / "lista.csv").write_text("id;classe;fachada\n1;janela;N\n", encoding="utf-8")
    assert foparq("init", tmp_path, "--lang", language)[0] == 0
    (line,) = [line for line in proposed(tmp_path).splitlines() if "ignore_layers = " in line]
    assert line.startswith("# "), "whether they are judged is for a person to say"
    assert set(tomllib.loads(line[2:])["ignore_layers"]) == {"EIXO", "A-COTAS", "Cota h"}
    assert load_manifest(tmp_path / "delivery.toml").drawing[0].ignore_layers == ()


def test_nothing_is_asked_where_no_layer_is_named_like_an_aid(foparq: Command, tmp_path: Path) -> None:
    draw(tmp_path / "fachada.dxf", "PAREDE", "COTOVELO", "EIXAMENTO")
    assert foparq("init", tmp_path)[0] == 0
    assert "ignore_layers" not in proposed(tmp_path)


def test_classes_and_facades_are_those_of_the_list(foparq: Command, tmp_path: Path) -> None:
    draw(tmp_path / "fachada_sul.dxf", "A-ESQ-JANELAS", "PORTA", "COTAS")
    rows = ["id;classe;fachada", "1;Janela;Norte", "2;Janela;Sul", "3;Porta de madeira;Sul", "4;Gárgula;Sul"]
    (tmp_path / "lista.csv").write_text("\n".join(rows), encoding="utf-8")
    assert foparq("init", tmp_path, "--lang", "pt")[0] == 0
    text = proposed(tmp_path)
    for name in ('"Janela"', '"Porta de madeira"', '"Gárgula"', '"Norte"', '"Sul"'):
        assert name in text
    assert '# facade = "Sul"' in text
    assert re.search(r"^#   A-ESQ-JANELAS +Janela$", text, re.MULTILINE)
    assert re.search(r"^#   PORTA +Porta de madeira$", text, re.MULTILINE)
    assert re.search(r"^#   COTAS +–$", text, re.MULTILINE)
    assert load_manifest(tmp_path / "delivery.toml").drawing[0].classes == {}, "what is proposed is for a person to say"
    (tmp_path / "delivery.toml").write_text(re.sub(r"^# (classes|facade)", r"\1", text, flags=re.MULTILINE))
    section = load_manifest(tmp_path / "delivery.toml").drawing[0]
    assert (section.facade, section.classes) == ("Sul", {"A-ESQ-JANELAS": "Janela", "PORTA": "Porta de madeira"})


@pytest.mark.parametrize("language", ["en", "pt-BR"])
def test_revisions_are_asked_about(foparq: Command, tmp_path: Path, language: str) -> None:
    for name in ("norte_rev1.dxf", "norte_rev2.dxf", "norte_rev10.dxf", "sul.dxf"):
        draw(tmp_path / name)
    shutil.copy(tmp_path / "sul.dxf", tmp_path / "sul.bak")
    (tmp_path / "~$pontos.xlsx").write_bytes(b"user")
    for name in ("pontos_v1.csv", "pontos_v2.csv"):
        (tmp_path / name).write_text("id;x;y;z\nP1;1,5;2,5;3,5\n", encoding="utf-8")
    code, out, _ = foparq("init", tmp_path, "--lang", language)
    assert code == 0
    manifest = load_manifest(tmp_path / "delivery.toml")
    assert [section.path for section in manifest.drawing] == ["norte_rev10.dxf", "sul.dxf"], "none is counted twice"
    assert manifest.checkpoints is not None
    assert manifest.checkpoints.path == "pontos_v2.csv"
    for name in ("norte_rev1.dxf", "norte_rev2.dxf", "pontos_v1.csv", "sul.bak", "~$pontos.xlsx"):
        assert name in out
        assert name in proposed(tmp_path)
    assert out.count("?") == 3
    other = "norte_rev2.dxf"
    changed = proposed(tmp_path).replace(f'# [[drawing]]\n# path = "{other}"', f'[[drawing]]\npath = "{other}"')
    (tmp_path / "delivery.toml").write_text(changed, encoding="utf-8")
    paths = [section.path for section in load_manifest(tmp_path / "delivery.toml").drawing]
    assert paths == ["norte_rev10.dxf", other, "sul.dxf"], "without the # the other one holds"


@pytest.mark.parametrize(
    ("paths", "latest"),
    [
        (("f_rev1.dxf", "f_rev2.dxf"), "f_rev2.dxf"), (("f-R9.dxf", "f-R10.dxf"), "f-R10.dxf"),
        (("f revA.dxf", "f revB.dxf"), "f revB.dxf"), (("f.dxf", "f v2.dxf"), "f v2.dxf"),
        (("f - Cópia.dxf", "f.dxf"), "f.dxf"), (("f (1).dxf", "f.dxf"), "f.dxf"), (("f_old.dxf", "f.dxf"), "f.dxf"),
        (("f_rev2.dxf", "f_rev2_final.dxf"), "f_rev2_final.dxf"), (("F_REV3.DXF", "f_rev1.dxf"), "F_REV3.DXF"),
        (("f_Revisão 2.dxf", "f.dxf"), "f_Revisão 2.dxf"), (("f_rev3 - copia.dxf", "f_rev2.dxf"), "f_rev2.dxf"),
    ],
)  # fmt: skip
def test_the_latest_by_its_name(paths: tuple[str, str], latest: str) -> None:
    one, two = map(revision_of, paths)
    assert one.base == two.base
    assert max(paths, key=lambda path: revision_of(path).rank) == latest


@pytest.mark.parametrize(
    ("one", "two"),
    [("fachada-1.dxf", "fachada-2.dxf"), ("corte_A.dxf", "corte_B.dxf"), ("a/f_rev1.dxf", "b/f_rev2.dxf"),
     ("norte.dxf", "nortev2.dxf"), ("arv1.dxf", "arv2.dxf"), ("rev1.dxf", "rev2.dxf"), ("bar.dxf", "bar1.dxf")],
)  # fmt: skip
def test_names_that_state_no_revision(one: str, two: str) -> None:
    assert revision_of(one).base != revision_of(two).base


def test_files_that_programs_keep_for_themselves() -> None:
    assert all(map(is_aside, ("a/~$p.xlsx", "f.BAK", "f.dxf.bak", "f.dwl2", ".~lock.p.ods#", "f.sv$")))
    assert not any(map(is_aside, ("f.dxf", "bak.dxf", "p~$.csv")))


@pytest.mark.parametrize("language", ["en", "pt-BR"])
def test_why_a_table_was_not_taken(foparq: Command, tmp_path: Path, language: str) -> None:
    draw(tmp_path / "a.dxf")
    (tmp_path / "b.csv").write_text("id;Medida em campo;Medida no desenho\nD1;1,5;#N/D\n", encoding="utf-8")
    (tmp_path / "c.csv").write_text("Marca;Coord 1;Coord 2\nA;1;2\n", encoding="utf-8")
    (tmp_path / "d.txt").write_text("Leia-me: nada\n", encoding="utf-8")
    book = openpyxl.Workbook()
    book.active.append(["id", "classe", "quantidade"])
    book.active.append(["J1", "janela", "duas"])
    book.save(tmp_path / "e.xlsx")
    assert foparq("init", tmp_path, "--lang", language)[0] == 0
    lines = {line[4:5]: line for line in proposed(tmp_path).splitlines() if line.startswith("#   ")}
    manifest = load_manifest(tmp_path / "delivery.toml")
    assert (manifest.features, manifest.checkpoints, manifest.distances) == (None, None, None)
    word = {"en": ("distances", "features"), "pt-BR": ("distâncias", "feições")}[language]
    assert word[0] in lines["b"]
    assert all(said in lines["b"] for said in ("#N/D", "Medida no desenho", "2"))
    assert all(said in lines["c"] for said in ("Marca", "Coord 1", "easting"))
    assert lines["d"].strip("# ") == "d.txt", "a letter is no table that went wrong"
    assert word[1] in lines["e"]
    assert "duas" in lines["e"]


def test_measured_beside_drawn(foparq: Command, tmp_path: Path) -> None:
    draw(tmp_path / "a.dxf")
    (tmp_path / "d.csv").write_text("Nº;Medida no desenho;Medida em campo\n1;1,5;1,52\n", encoding="utf-8")
    assert foparq("init", tmp_path)[0] == 0
    manifest = load_manifest(tmp_path / "delivery.toml")
    assert manifest.distances is not None
    assert manifest.distances.path == "d.csv"
    before, _, _ = proposed(tmp_path).rpartition('# survey_sd = "3 mm"')
    assert "Q2" in before.splitlines()[-1] + before.splitlines()[-2], "what it means stands above it"


def test_prints_and_dwg_alone_are_told(foparq: Command, tmp_path: Path) -> None:
    (tmp_path / "a.dwg").write_bytes(b"AC1032" + bytes(20))
    (tmp_path / "b.pdf").write_bytes(b"%PDF-1.7\n")
    code, _, err = foparq("init", tmp_path, "--lang", "pt")
    assert code == 2
    assert all(word in err for word in ("a.dwg", "b.pdf", "DXF", "DWG"))
    assert not (tmp_path / "delivery.toml").exists()


def test_dimensions_beside_a_facade_do_not_turn_its_plane(foparq: Command, tmp_path: Path) -> None:
    document = ezdxf.readfile(draw(tmp_path / "a.dxf"))
    model = document.modelspace()
    model.delete_all_entities()
    model.add_line((0, 100, 0), (12, 100, 5))
    model.add_text("12,00", dxfattribs={"insert": (0, 0, 0)})
    document.saveas(tmp_path / "a.dxf")
    assert foparq("init", tmp_path)[0] == 0
    assert load_manifest(tmp_path / "delivery.toml").drawing[0].plane == "xz"


@pytest.mark.parametrize(
    ("layer", "like"),
    [
        ("A-ESQ-JANELAS", "janela"), ("JAN", "janela"), ("PORTÕES", None), ("a-porta-2", "door"), ("COTAS", None),
        ("CIMALHA", "cornija"), ("0", None), ("JA", None),
    ],
)  # fmt: skip
def test_a_layer_named_like_a_class(layer: str, like: str | None) -> None:
    assert class_like(layer, ["cornija", "door", "janela"]) == like


def test_a_file_named_like_a_facade() -> None:
    assert facade_like("a/Fachada LESTE rev2.dxf", ["Norte", "Leste"]) == "Leste"
    assert facade_like("fachada.dxf", ["a", "N"]) is None


@pytest.mark.parametrize("seed", [2, 3])
def test_a_sound_delivery_is_accepted_at_the_first_audit_after_init(foparq: Command, tmp_path: Path, seed: int) -> None:
    made = office(seed)
    folder = office_files.write(made, tmp_path / "entrega")
    (folder / "delivery.toml").unlink()
    assert foparq("init", folder, "--lang", "pt")[0] == 0
    text = proposed(folder).replace('# scale = "1:50"', f'scale = "1:{made.scale}"')
    text = re.sub(r"^# (unit|facade|classes|survey_sd) = ", r"\1 = ", text, flags=re.MULTILINE)
    points, lengths = (f'survey_sd = "{sd * 1000:.4f} mm"' for sd in (made.survey_sd, made.distance_sd))
    text = text.replace('survey_sd = "3 mm"', points, 1).replace('survey_sd = "3 mm"', lengths, 1)
    (folder / "delivery.toml").write_text(text, encoding="utf-8")
    code, out, err = foparq("audit", folder)
    assert (code, err) == (0, ""), out
