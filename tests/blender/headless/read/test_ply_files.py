"""Files in .ply that are whole, but not as Blender wants them."""

from math import cos, sin, tau

import pytest
from headless.loading import load
from weak_convex_decomposition.core.errors import DecompositionError
from weak_convex_decomposition.operators.headless.files.headers import read_header


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


@pytest.mark.parametrize(
    "words",
    ["element Face", "ELEMENT face", "property LIST", "property Float", "END_HEADER"],
)
def test_words_of_the_header_in_capitals(tmp_path, words):
    text = prism(16)  # as many points as a cloud needs
    (tmp_path / "a.ply").write_text(text.replace(words.lower(), words))
    with pytest.raises(DecompositionError, match=f'"{words}.*", which Blender reads'):
        load(tmp_path / "a.ply")


@pytest.mark.parametrize("name", ["faces", "polygon"])
def test_faces_by_another_name(tmp_path, name):
    text = prism(16).replace("element face", f"element {name}")
    (tmp_path / "a.ply").write_text(text)
    with pytest.raises(DecompositionError, match=f'"element {name}" and not as'):
        load(tmp_path / "a.ply")


def test_lines_of_a_header_that_no_file_has():
    data = prism(5).encode()
    for known in b"comment elementt 3", b"obj_info x", b"Comment", b"":
        assert read_header(data.replace(b"\nelement", b"\n%b\nelement" % known, 1))
    for unknown in b"elementt uchar int a", b"element vertex 10 4", b"property", b"v":
        line = b"\n%b\nend_header" % unknown
        assert read_header(data.replace(b"\nend_header", line)) is None


def test_names_that_blender_does_not_need_may_have_capitals(tmp_path):
    more = "comment Element Face\nelement Camera 0\nproperty int ID\nend_header"
    text = prism(5, corners="Vertex_Indices").replace("end_header", more)
    (tmp_path / "a.ply").write_text(text)
    (obj,) = load(tmp_path / "a.ply")
    assert len(obj.data.polygons) == 7


def test_one_of_several_properties_of_faces_has_their_vertices(tmp_path):
    text = prism(5, corners="Vertex_Indices\nproperty int flag")
    lines = text.splitlines()
    lines[-7:] = [f"{line} 0" for line in lines[-7:]]
    for name, refused in (("Vertex_Indices", True), ("vertex_index", False)):
        text = "\n".join(lines).replace("Vertex_Indices", name)
        (tmp_path / "a.ply").write_text(text)
        if refused:
            with pytest.raises(DecompositionError, match="without vertex_indices or"):
                load(tmp_path / "a.ply")
        else:
            assert load(tmp_path / "a.ply")


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
