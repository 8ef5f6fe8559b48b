"""Files in .ply that are whole, but not as Blender wants them."""

from math import cos, sin, tau

import pytest
from headless.loading import load
from weak_convex_decomposition.core.errors import DecompositionError


def prism(n_sides, axes="xyz", corners="vertex_indices"):
    """Return a prism in text form, whose length counts may be large."""
    turns = [tau * n / n_sides for n in range(n_sides)]
    vertices = [(cos(turn), sin(turn), z) for z in (0, 1) for turn in turns]
    walls = [(n, (n + 1) % n_sides) for n in range(n_sides)]
    faces = [
        [*range(n_sides)][::-1],
        [*range(n_sides, 2 * n_sides)],
        *((a, b, b + n_sides, a + n_sides) for a, b in walls),
    ]
    head = ["ply", "format ascii 1.0", f"element vertex {len(vertices)}"]
    head += [f"property float {axis}" for axis in axes]
    head += [f"element face {len(faces)}", f"property list int int {corners}"]
    rows = [*vertices, *((len(face), *face) for face in faces)]
    text = [*head, "end_header", *(" ".join(map(str, row)) for row in rows)]
    return "\n".join(text) + "\n"


@pytest.mark.parametrize("axes", ["XYZ", "xYz", "xyq"])
def test_vertices_whose_coordinates_have_other_names(tmp_path, axes):
    (tmp_path / "a.ply").write_text(prism(5, axes))
    with pytest.raises(DecompositionError, match="x, y and z, which Blender reads in"):
        load(tmp_path / "a.ply")


def test_faces_of_many_corners(tmp_path):
    (tmp_path / "a.ply").write_text(prism(255))
    (obj,) = load(tmp_path / "a.ply")
    assert len(obj.data.polygons) == 257
    (tmp_path / "a.ply").write_text(prism(256))
    with pytest.raises(DecompositionError, match="faces of more than 255 corners"):
        load(tmp_path / "a.ply")


def test_the_only_list_of_faces_has_their_vertices_whatever_its_name(tmp_path):
    text = prism(5, corners="loops")
    (tmp_path / "a.ply").write_text(text)
    (obj,) = load(tmp_path / "a.ply")
    assert len(obj.data.polygons) == 7
    (tmp_path / "a.ply").write_text(text.replace("4 0 1 6 5", "4 0 1 6 99"))
    with pytest.raises(DecompositionError, match="refers to vertices that are missing"):
        load(tmp_path / "a.ply")
