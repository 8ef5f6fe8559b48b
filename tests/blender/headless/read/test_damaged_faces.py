"""Damaged files whose faces or coordinates Blender would leave out or misread."""

import struct
import time
from codecs import BOM_UTF8

import bpy
import numpy as np
import pytest
from hand_made import add_ring, decompose_by_hand
from headless.loading import load
from weak_convex_decomposition.core.errors import DecompositionError
from weak_convex_decomposition.operators.headless.files.headers import read_header
from weak_convex_decomposition.operators.headless.read.ply_checks import (
    refers_to_missing,
)

VERTICES = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
TRIANGLES = [(0, 2, 1), (0, 1, 3), (0, 3, 2)]
MIXED = [(0, 2, 1), (0, 1, 3, 2), (1, 2, 3)]
ORDERS = {"ascii": "", "binary_little_endian": "<", "binary_big_endian": ">"}
EXTRA = ("", "property uchar flag")
MISSING = "refers to vertices that are missing"


def ply(form, faces, extra="", strips=""):
    """Return a .ply file; `extra` is a property of faces, before and after their lists.

    `strips` are lists of an element of its own, between vertices and faces.
    """
    order = ORDERS[form]
    head = f"ply\nformat {form} 1.0\nelement vertex {len(VERTICES)}\n"
    head += "".join(f"property float {axis}\n" for axis in "xyz")
    if strips:
        head += f"element strip {len(strips)}\nproperty list uchar int members\n"
    head += f"element face {len(faces)}\n"
    first, last = (f"{extra}_{n}\n" if extra else "" for n in (1, 2))
    head += f"{first}property list uchar int vertex_indices\n{last}end_header\n"
    flag = [7] if extra else []
    if not order:
        rows = [*VERTICES, *((len(each), *each) for each in strips)]
        rows += [(*flag, len(face), *face, *flag) for face in faces]
        return (head + "".join(" ".join(map(str, row)) + "\n" for row in rows)).encode()
    data = b"".join(struct.pack(f"{order}3f", *vertex) for vertex in VERTICES)
    for each in strips:
        data += struct.pack(f"{order}B{len(each)}i", len(each), *each)
    for face in faces:
        row = struct.pack(f"{order}B{len(face)}i", len(face), *face)
        data += bytes(flag) + row + bytes(flag)
    return head.encode() + data


def with_corner(faces, corner):
    """Return faces of which the second one has another vertex."""
    (_, *rest) = faces[1]
    return [faces[0], (corner, *rest), *faces[2:]]


@pytest.mark.parametrize("form", ORDERS)
@pytest.mark.parametrize("faces", [TRIANGLES, MIXED], ids=["equal", "mixed"])
@pytest.mark.parametrize("extra", EXTRA)
def test_ply_faces_without_their_vertices(tmp_path, unexpected, form, faces, extra):
    cases = {
        f"{corner}.ply": (ply(form, with_corner(faces, corner), extra), MISSING)
        for corner in (4, 1000, -1)
    }
    assert unexpected(cases) == {}
    (tmp_path / "a.ply").write_bytes(ply(form, faces, extra))
    assert len(load(tmp_path / "a.ply")[0].data.polygons) == len(faces)


@pytest.mark.parametrize("form", ORDERS)
@pytest.mark.parametrize("strips", [[(9, 9), (9, 9)], [(9, 9), (9,)]])
def test_other_lists_before_the_faces(form, strips):
    for corner, is_missing in ((0, False), (4, True)):
        data = ply(form, with_corner(MIXED, corner), strips=strips)
        assert refers_to_missing(read_header(data), data) == is_missing


@pytest.mark.parametrize("form", ORDERS)
def test_properties_of_several_words_and_of_one_name(tmp_path, form):
    path = tmp_path / "a.ply"
    data = ply(form, MIXED, "property uchar flag")
    for names in ("Part 01", "Part 02"), ("flag", "flag"):
        path.write_bytes(
            data.replace(b"flag_1", names[0].encode()).replace(
                b"flag_2", names[1].encode()
            )
        )
        assert len(load(path)[0].data.polygons) == len(MIXED)
    header = read_header(data.replace(b"flag_1", b"x y").replace(b"flag_2", b"x y"))
    names = ["x y", "vertex_indices", "x y again"]
    assert list(header.elements[1].properties) == names


def test_models_with_weights_come_back(tmp_path):
    ring = add_ring("Ring")
    decompose_by_hand(ring, 2)
    bpy.ops.wm.ply_export(filepath=str(tmp_path / "a.ply"))
    assert b"property float Part 01" in (tmp_path / "a.ply").read_bytes()
    assert len(load(tmp_path / "a.ply")[0].data.polygons) == 288


@pytest.mark.parametrize("form", [form for form, order in ORDERS.items() if order])
@pytest.mark.parametrize("faces", [TRIANGLES, MIXED], ids=["equal", "mixed"])
@pytest.mark.parametrize("extra", EXTRA)
@pytest.mark.parametrize("strips", ["", [(9, 9), (9, 9)], [(9, 9), (9,)]])
def test_every_cut_through_binary_rows_is_noticed(form, faces, extra, strips):
    data = ply(form, faces, extra, strips)
    header = read_header(data)
    assert header.is_whole(data)
    assert header.is_whole(data + b"more")
    for size in range(header.size, len(data)):
        assert not header.is_whole(data[:size]), size


@pytest.mark.parametrize("element", ["vertex 4", "face 3"])
def test_files_that_promise_more_rows_than_any_has(element):
    data = ply("binary_little_endian", MIXED)
    data = data.replace(element.encode(), element[:-1].encode() + b"9" * 18)
    assert not read_header(data).is_whole(data)


def test_the_last_face_of_a_million():
    n_faces = 1_000_000
    head = "ply\nformat binary_big_endian 1.0\nelement vertex 3\nproperty float x\n"
    head += f"element face {n_faces}\nproperty list uchar int vertex_indices\n"
    rows = struct.pack(">B3i", 3, 0, 1, 2) * (n_faces - 1)
    for corner, is_missing in ((2, False), (3, True)):
        last = struct.pack(">B3i", 3, 0, 1, corner)
        data = f"{head}end_header\n".encode() + bytes(12) + rows + last
        began = time.process_time()
        assert read_header(data).is_whole(data)
        assert time.process_time() - began < 0.1
        assert refers_to_missing(read_header(data), data) == is_missing


@pytest.mark.parametrize("form", ORDERS)
def test_lists_whose_lengths_are_no_whole_numbers(unexpected, form):
    for kind in ("float", "double"):
        data = ply(form, MIXED).replace(b"list uchar", f"list {kind}".encode())
        assert unexpected({"a.ply": (data, "header is not one of a .ply file")}) == {}


def test_other_numbers_in_text(tmp_path, unexpected):
    cases = ("3.0", "no error"), ("4.0", MISSING), ("9" * 40, MISSING), ("", MISSING)
    for index, message in cases:
        text = ply("ascii", TRIANGLES).decode().replace("3 0 1 3", f"3 0 1 {index}")
        assert unexpected({"a.ply": (text.encode(), message)}) == {}


TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"


@pytest.mark.parametrize("word", ["0,5", "0x1", "1f", "1.2.3", "one", "-", "1e"])
def test_obj_with_words_where_numbers_should_be(unexpected, word):
    text = TRIANGLE.replace("v 1 0 0", f"v 1 \t{word} 0")
    sentence = "has words where numbers should be"
    assert unexpected({"a.obj": (text.encode(), sentence)}) == {}


@pytest.mark.parametrize("corners", ["a b c", "1 2 x", "1 2 3,5", "1 2 0x3", "1 2 -"])
def test_obj_with_words_for_corners(unexpected, corners):
    text = f"{TRIANGLE}f {corners}\n{TRIANGLE}"
    sentence = "has words where numbers should be"
    assert unexpected({"a.obj": (text.encode(), sentence)}) == {}


def test_obj_with_unusual_corners(tmp_path):
    path = tmp_path / "a.obj"
    rows = ["+1 2 4", "1/ 2// 3", "1.0 -2 -1 # x", "4//1 2//1\t3//1"]
    text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvn 0 0 1\n"
    path.write_text(text + "".join(f"f {row}\n" for row in rows))
    assert len(load(path)[0].data.polygons) == 4


SOLID = (
    "solid a vertex\nfacet normal 0 0 1\nouter loop\n vertex 0 0 0\n vertex 1 0 0\n"
    " vertex 0 1 0\nendloop\nendfacet\nendsolid a vertex\n"
)


@pytest.mark.parametrize("row", ["1,5 0 0", "x y z", "1 0", "1 0 one", ""])
def test_stl_with_words_where_numbers_should_be(unexpected, row):
    text = SOLID.replace("vertex 1 0 0", f"vertex {row}")
    sentence = "has words where numbers should be"
    assert unexpected({"a.stl": (text.encode(), sentence)}) == {}


def test_stl_in_capital_letters_or_longer_than_its_header_says(unexpected):
    texts = SOLID.upper(), SOLID.replace(" vertex 1", " Vertex 1")
    cases = {f"{n}.stl": (text.encode(), "capital") for n, text in enumerate(texts)}
    cases["longer.stl"] = b"solid".ljust(80) + struct.pack("<I54x", 1), "does not fit"
    assert unexpected(cases) == {}


def test_stl_with_unusual_numbers(tmp_path):
    path = tmp_path / "a.stl"
    text = SOLID.replace("vertex 1 0 0", "vertex\t1. -.0  +0e-5 ")
    path.write_bytes(text.replace("\n", "\r\n").encode())
    (obj,) = load(path, "Z")
    corners = {tuple(vertex.co) for vertex in obj.data.vertices}
    assert corners == {(0, 0, 0), (0, 1, 0), (1, 0, 0)}


def test_obj_with_unusual_numbers(tmp_path):
    path = tmp_path / "a.obj"
    rows = ["1. .5 +1", "1E2 -1e-2 \\ \r\n 1", "\t1 0 0 red # 0,5", "0 0", "1 2 3#4"]
    text = (
        TRIANGLE + "".join(f"v {row}\n" for row in rows) + "f -1 -2 -3 -4 -5\n# v x\n"
    )
    path.write_bytes(text.encode())
    (obj,) = load(path, "Z")
    found = np.array([vertex.co for vertex in obj.data.vertices][3:])
    expected = [(1, 0.5, 1), (100, -0.01, 1), (1, 0, 0), (0, 0, 0), (1, 2, 3)]
    assert found == pytest.approx(np.array(expected), abs=1e-5)


def test_text_that_blender_cannot_read(tmp_path, unexpected):
    texts = {
        ".obj": [TRIANGLE, f"vn 0 0 1\n{TRIANGLE}", f"mtllib a.mtl\n{TRIANGLE}"],
        ".stl": [SOLID],
        ".ply": [ply("ascii", TRIANGLES).decode()],
    }
    for ending, contents in texts.items():
        for text in contents:
            marked = BOM_UTF8 + text.encode(), "begins with a byte order mark"
            old = text.replace("\n", "\r").encode(), "has line ends of old Macs"
            assert unexpected({f"a{ending}": marked, f"b{ending}": old}) == {}
    path = tmp_path / "b.obj"
    path.write_bytes(BOM_UTF8 + f"# of another program\n{TRIANGLE}".encode())
    assert len(load(path)[0].data.polygons) == 1


def test_the_reasons_of_importers_name_the_file_in_quotes(tmp_path):
    folder = tmp_path / "a folder: 1"
    folder.mkdir()
    heads = [b"Kaydara FBX Binary  \0\x1a\0\xe8\x1c\0\0"]
    if "fbx_import" in dir(bpy.ops.wm):  # others refuse text as such
        heads.append(b"; FBX 7.3.0 project file\n")
    for name in ("a.fbx", "it's.fbx"):
        for head in heads:
            (folder / name).write_bytes(head + b"hello")
            with pytest.raises(DecompositionError) as caught:
                load(folder / name)
            reason = str(caught.value).partition("(")[2]
            assert reason.count(f'"{name}"') == 1
            assert reason.count('"') == 2
            assert reason.replace("it's", "").replace("n't", "").count("'") == 0
            assert "folder" not in reason
