"""Coordinates in .gltf, .glb and .fbx files, of which Blender would make 0."""

import base64
import json
import struct
import warnings

import bpy
import numpy as np
import pytest
from headless.loading import load
from weak_convex_decomposition.core.errors import DecompositionError

CORNERS = [0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1]
FACES = [0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3]
FLOAT, BYTE = 5126, 5121


def tetrahedron(value, sparse=False):
    """Return what a glTF file says and its bytes; `value` is of one coordinate.

    A sparse one has other corners in all places but the last.
    """
    corners = [*CORNERS[:-1], value]
    data = struct.pack("<12f12B", *(CORNERS if sparse else corners), *FACES)
    data += struct.pack("<4B3f", 3, 0, 0, 0, *corners[9:])
    places = {"count": 4, "type": "VEC3", "componentType": FLOAT, "bufferView": 0}
    if sparse:
        indices = {"bufferView": 2, "componentType": BYTE}
        values = {"bufferView": 3}
        places["sparse"] = {"count": 1, "indices": indices, "values": values}
    faces = {"count": 12, "type": "SCALAR", "componentType": BYTE, "bufferView": 1}
    starts, lengths = (0, 48, 60, 64), (48, 12, 4, 12)
    return data, {
        "asset": {"version": "2.0"},
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [places, faces],
        "bufferViews": [
            {"buffer": 0, "byteOffset": start, "byteLength": length}
            for start, length in zip(starts, lengths, strict=True)
        ],
        "buffers": [{"byteLength": len(data)}],
    }


def write_beside(path, data, content):
    path.with_name("a.bin").write_bytes(data)
    content["buffers"][0]["uri"] = "a.bin"
    path.write_text(json.dumps(content))


def write_within(path, data, content):
    text = base64.b64encode(data).decode()
    content["buffers"][0]["uri"] = f"data:application/octet-stream;base64,{text}"
    path.write_text(json.dumps(content))


def write_binary(path, data, content):
    text = json.dumps(content).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text
    chunks += struct.pack("<I4s", len(data), b"BIN\0") + data
    path.write_bytes(struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks)


@pytest.mark.parametrize("value", [float("nan"), float("-inf")])
@pytest.mark.parametrize("sparse", [False, True])
@pytest.mark.parametrize(
    ("ending", "write"),
    [(".gltf", write_beside), (".gltf", write_within), (".glb", write_binary)],
)
def test_gltf(tmp_path, ending, write, sparse, value):
    path = tmp_path / f"a{ending}"
    write(path, *tetrahedron(2.0, sparse))
    (obj,) = load(path)
    assert obj.dimensions.y == 2
    write(path, *tetrahedron(value, sparse))
    with pytest.raises(DecompositionError, match=rf"a\{ending} has .* not finite"):
        load(path)


def test_gltf_meshes_that_are_not_shown_may_be_anything(tmp_path):
    data, content = tetrahedron(1.0)
    content["meshes"] += [{"primitives": [{"attributes": {"POSITION": 7}}]}]
    write_within(tmp_path / "a.gltf", data, content)
    assert len(load(tmp_path / "a.gltf")) == 1


@pytest.mark.parametrize("n_vertices", [4, 400])  # many are compressed
def test_binary_fbx(tmp_path, n_vertices):
    path = tmp_path / "a.fbx"
    places = np.random.default_rng(0).random((n_vertices, 3))
    for value in (0.5, float("nan")):
        places[3, 1] = value
        bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
        mesh = bpy.data.meshes.new("a")
        mesh.from_pydata(places, [], [(0, 1, 2), (1, 2, 3)])
        bpy.context.collection.objects.link(bpy.data.objects.new("a", mesh))
        with warnings.catch_warnings():  # of NumPy, about Blender's exporter
            warnings.simplefilter("ignore", DeprecationWarning)
            bpy.ops.export_scene.fbx(filepath=str(path))
        if value == 0.5:
            assert len(load(path)) == 1
    with pytest.raises(DecompositionError, match=r"a\.fbx has .* not finite"):
        load(path)


def old_node(start, name, values, children=()):
    """Return a node of a binary .fbx file before version 7; `start` is its place."""
    packed = b"".join(
        b"S" + struct.pack("<I", len(each)) + each
        if isinstance(each, bytes)
        else each.dtype.char.upper().encode() + each.tobytes()
        for each in values
    )
    first = start + 13 + len(name) + len(packed)
    below = b""
    for child in children:
        below += old_node(first + len(below), *child)
    below += bytes(13) if children else b""
    head = (first + len(below), len(values), len(packed), len(name))
    return struct.pack("<IIIB", *head) + name + packed + below


def old_fbx(value, kind):
    """Return a binary .fbx file of version 6.1; `value` is of one coordinate."""
    corners = np.array([*CORNERS[:7], value, *CORNERS[8:]], kind)
    loops = np.array([0, 2, -2, 0, 1, -4, 1, 2, -4, 2, 0, -4], "i")
    mesh = [(b"Vertices", corners), (b"PolygonVertexIndex", loops)]
    link = [b"OO", b"A\0\1Model", b"Scene\0\1Model"]
    data = b"Kaydara FBX Binary  \0\x1a\0" + struct.pack("<I", 6100)
    data += old_node(len(data), b"Objects", [], [(b"Model", [link[1], b"Mesh"], mesh)])
    data += old_node(len(data), b"Connections", [], [(b"Connect", link)])
    return data + bytes(13)


TEXT_FBX = """; FBX 7.4.0 project file
FBXHeaderExtension:  {
    FBXVersion: 7400
}
Objects:  {
    Geometry: 1, "Geometry::", "Mesh" {
        Vertices: *12 {
            a: 0,0,0,1,0,0,0,%s,0,0,0,1
        }
        PolygonVertexIndex: *12 {
            a: 0,2,-2,0,1,-4,1,2,-4,2,0,-4
        }
    }
    Model: 2, "Model::A", "Mesh" {
    }
}
Connections:  {
    C: "OO",2,0
    C: "OO",1,2
}
"""

if "fbx_import" in dir(bpy.ops.wm):

    @pytest.mark.parametrize("kind", ["d", "f"])
    def test_binary_fbx_before_version_7(tmp_path, kind):
        path = tmp_path / "a.fbx"
        path.write_bytes(old_fbx(1.0, kind))
        assert len(load(path)[0].data.polygons) == 4
        path.write_bytes(old_fbx(float("nan"), kind))
        with pytest.raises(DecompositionError, match=r"a\.fbx has .* not finite"):
            load(path)

    @pytest.mark.parametrize("word", ["nan", "-inf", "1e999", "-1.#IND", "1.#INF"])
    def test_fbx_in_text_form(tmp_path, word):
        path = tmp_path / "a.fbx"
        path.write_text(TEXT_FBX % "1e-3")
        assert len(load(path)[0].data.polygons) == 4
        path.write_text(TEXT_FBX % word)
        with pytest.raises(DecompositionError, match=r"a\.fbx has .* not finite"):
            load(path)

else:

    def test_fbx_in_text_form(tmp_path):
        (tmp_path / "a.fbx").write_text(TEXT_FBX % 1)
        with pytest.raises(DecompositionError, match="text form, which Blender"):
            load(tmp_path / "a.fbx")
