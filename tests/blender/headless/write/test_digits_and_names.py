"""Coordinates keep their digits, whatever the size; names stay legal and distinct."""

import bpy
import numpy as np
import pytest
import trimesh
from hand_made import add_ring, build_hulls, decompose_by_hand
from weak_convex_decomposition.core.parameters.bodies import BodyParameters
from weak_convex_decomposition.operators.headless.write.hull_files import save_hulls
from weak_convex_decomposition.operators.headless.write.model_files import save
from weak_convex_decomposition.operators.headless.write.names import legal_names
from weak_convex_decomposition.operators.headless.write.placed_meshes import (
    matrix_of,
    placed,
)

SIZES = [1e-6, 1.0, 1e6]


def sized_ring(size):
    """Return a ring of another size, around the origin."""
    ring = add_ring("Ring", (size, size * 1.5, -size))
    ring.location = (0, 0, 0)
    bpy.context.view_layer.update()
    return ring


def vertices_in(path):
    """Return the coordinates of an .obj file, and the names of its objects."""
    lines = path.read_text(encoding="utf-8").splitlines()
    vertices = [line.split()[1:] for line in lines if line.startswith("v ")]
    names = [line[2:] for line in lines if line.startswith("o ")]
    return np.array(vertices, dtype=float), names


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("up", ["Y", "Z"])
def test_a_model_keeps_its_digits(tmp_path, size, up):
    ring = sized_ring(size)
    decompose_by_hand(ring, 2)
    save(tmp_path / "a.obj", up)
    written, _ = vertices_in(tmp_path / "a.obj")
    expected, _, _ = placed(ring, matrix_of(ring))
    if up == "Y":
        expected = expected[:, [0, 2, 1]] * (1, 1, -1)
    assert written == pytest.approx(expected, abs=1e-8 * size)
    assert "usemtl Part_01" in (tmp_path / "a.obj").read_text(encoding="utf-8")


@pytest.mark.parametrize("size", SIZES)
def test_hulls_keep_their_digits(tmp_path, size):
    hulls = build_hulls([sized_ring(size)], max_hulls=2)
    expected = np.concatenate([placed(hull, matrix_of(hull))[0] for hull in hulls])
    save_hulls(tmp_path / "a.obj", hulls, "Z", BodyParameters())
    written, names = vertices_in(tmp_path / "a.obj")
    assert written == pytest.approx(expected, abs=1e-8 * size)
    assert names == ["Ring_hull_01", "Ring_hull_02"]
    loaded = trimesh.load(tmp_path / "a.obj", process=False)
    assert loaded.is_volume
    assert loaded.body_count == len(hulls)


def test_objects_and_groups_of_a_model_have_names_of_their_own(tmp_path):
    for name in ("A b", "A_b", "A\tb"):
        decompose_by_hand(add_ring(name), 2)
    save(tmp_path / "a.obj", "Z")
    lines = (tmp_path / "a.obj").read_text(encoding="utf-8").splitlines()
    names = [line[2:] for line in lines if line.startswith("o ")]
    groups = [line[2:] for line in lines if line.startswith("g ")]
    assert len(set(names)) == 3
    assert len(set(groups)) == 6
    assert not any(" " in name or "\t" in name for name in names)


def test_hulls_have_the_names_that_their_objects_have_in_the_file(tmp_path):
    rings = [add_ring(name) for name in ("A b", "A_b")]
    rings[1].location.x += 9
    save(tmp_path / "model.obj", "Z")
    hulls = build_hulls(rings, max_hulls=1, naming="UNREAL")
    save_hulls(tmp_path / "a.obj", hulls, "Z", BodyParameters())
    assert vertices_in(tmp_path / "a.obj")[1] == ["UCX_A_b_2_01", "UCX_A_b_01"]
    model, names = vertices_in(tmp_path / "model.obj")
    assert names == ["A_b_2", "A_b"]
    assert model[-1, 0] > model[0, 0] + 5


@pytest.mark.parametrize(
    ("form", "names", "legal"),
    [
        ("obj", ["A b", "A_b", "A\nb"], ["A_b_2", "A_b", "A_b_3"]),
        ("obj", ["", "x", ""], ["unnamed", "x", "unnamed_2"]),
        ("xml", ["a/b", 'a"b', "a b", "é"], ["a_b", "a_b_2", "a b", "é"]),
        ("xml", ["a\x01b", "a\ud800b", " "], ["a_b", "a_b_2", "unnamed"]),
        ("usd", ["1é", "_1_", "a", "a"], ["_1__2", "_1_", "a", "a_2"]),
        ("usd", ["a_2", "a.", "a_"], ["a_2", "a__2", "a_"]),
    ],
)
def test_legal_names(form, names, legal):
    assert legal_names(names, form) == legal
    assert legal_names(legal, form) == legal


def test_thousands_of_equal_names():
    assert legal_names(["A b"] * 4000, "obj")[-1] == "A_b_4000"
