"""A strict check of .glb files: lengths, ranges, bounds and references."""

import json
import struct

import numpy as np
import pytest

TYPES = {
    **{5120: np.int8, 5121: np.uint8, 5122: np.int16, 5123: np.uint16},
    **{5125: np.uint32, 5126: np.float32},
}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}


@pytest.fixture
def checked_glb():
    """Return a function that checks a .glb file; it returns what `_checked` does."""
    return _checked


def _checked(path):
    """Return the JSON of a .glb file and its accessors' arrays; assert it is valid."""
    data = path.read_bytes()
    magic, version, length = struct.unpack_from("<4sII", data)
    assert (magic, version, length) == (b"glTF", 2, len(data))
    n_text, kind = struct.unpack_from("<I4s", data, 12)
    assert kind == b"JSON"
    assert n_text % 4 == 0
    scene = json.loads(data[20 : 20 + n_text])
    n_binary, kind = struct.unpack_from("<I4s", data, 20 + n_text)
    assert kind == b"BIN\0"
    binary = data[28 + n_text :]
    assert len(binary) == n_binary
    assert 0 <= n_binary - scene["buffers"][0]["byteLength"] < 4
    arrays = [_array(each, scene, binary) for each in scene["accessors"]]
    _check_meshes(scene, arrays)
    _check_nodes(scene)
    return scene, arrays


def _array(accessor, scene, binary):
    """Return the values of an accessor, which lie in its view and in its bounds."""
    view = scene["bufferViews"][accessor["bufferView"]]
    dtype, width = TYPES[accessor["componentType"]], WIDTHS[accessor["type"]]
    start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
    assert start % np.dtype(dtype).itemsize == 0
    n_bytes = accessor["count"] * width * np.dtype(dtype).itemsize
    assert accessor.get("byteOffset", 0) + n_bytes <= view["byteLength"]
    assert view.get("byteOffset", 0) + view["byteLength"] <= len(binary)
    values = np.frombuffer(binary, dtype, accessor["count"] * width, start)
    values = values.reshape(-1, width)
    assert np.isfinite(values).all()
    for name, bound in (("min", values.min(axis=0)), ("max", values.max(axis=0))):
        if name in accessor:
            assert np.array_equal(bound, np.array(accessor[name], dtype)), name
    return values


def _check_meshes(scene, arrays):
    """Assert that every corner is a vertex, and every vertex is used."""
    for mesh in scene["meshes"]:
        for primitive in mesh["primitives"]:
            attributes = primitive["attributes"]
            counts = {len(arrays[number]) for number in attributes.values()}
            assert len(counts) == 1
            position = scene["accessors"][attributes["POSITION"]]
            assert {"min", "max"} <= position.keys()
            if primitive.get("mode") == 0:  # points
                continue
            corners = arrays[primitive["indices"]].ravel()
            assert len(corners) % 3 == 0
            assert sorted(set(corners.tolist())) == list(range(counts.pop()))
            if "NORMAL" in attributes:
                lengths = np.linalg.norm(arrays[attributes["NORMAL"]], axis=1)
                assert np.abs(lengths - 1).max() < 1e-3
            assert 0 <= primitive.get("material", 0) < len(scene.get("materials", "x"))


def _check_nodes(scene):
    """Assert that nodes form trees, and that extensions are declared."""
    nodes = scene["nodes"]
    children = [child for node in nodes for child in node.get("children", ())]
    roots = [root for each in scene["scenes"] for root in each["nodes"]]
    assert sorted(children + roots) == list(range(len(nodes)))
    used = {name for node in nodes for name in node.get("extensions", ())}
    assert used <= set(scene.get("extensionsUsed", ()))
    for node in nodes:
        assert 0 <= node.get("mesh", 0) < len(scene["meshes"])
        collider = node.get("extensions", {}).get("KHR_physics_rigid_bodies")
        if collider:
            assert "mesh" in nodes[collider["collider"]["geometry"]["node"]]
