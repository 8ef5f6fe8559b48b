import struct
import warnings

import bpy
import pytest
from hand_made import in_scene
from headless.loading import load
from weak_convex_decomposition.core.errors import DecompositionError
from weak_convex_decomposition.operators.headless.formats import READ_ENDINGS

# A wedge unlike itself in every direction, Z up.
MESH_ENDINGS = sorted(set(READ_ENDINGS) - {".xyz", ".pwn", ".pts"})
VERTICES = [(0, 0, 0), (3, 0, 0), (3, 2, 0), (0, 2, 0), (0, 0, 1), (0, 2, 1)]
FACES = [(0, 3, 2, 1), (0, 1, 4), (3, 5, 2), (1, 2, 5, 4), (0, 4, 5, 3)]
PLY = (
    "ply\nformat {} 1.0\nelement vertex 3\n{}element face 1\n"
    "property list uchar int vertex_indices\nend_header\n"
)
XYZ = "property float x\nproperty float y\nproperty float z\n"
NORMAL = "property float nx\n"


def write_off(path, header="OFF\n6 5 0"):
    rows = [header, *(" ".join(map(str, v)) for v in VERTICES)]
    rows += [" ".join(map(str, (len(f), *f))) for f in FACES]
    path.write_text("\n".join(rows) + "\n")


def write_wedge(path):
    """Write the wedge to a file of any kind, by Blender's own means."""
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    mesh = bpy.data.meshes.new("wedge")
    mesh.from_pydata(VERTICES, [], FACES)
    bpy.context.collection.objects.link(bpy.data.objects.new("wedge", mesh))
    bpy.context.view_layer.update()
    name = {"filepath": str(path)}
    scenes, files = bpy.ops.export_scene, bpy.ops.wm
    exporters = {
        ".obj": lambda: files.obj_export(**name),
        ".ply": lambda: files.ply_export(**name),
        ".stl": lambda: files.stl_export(**name),
        ".off": lambda: write_off(path),
        ".glb": lambda: scenes.gltf(**name),
        ".gltf": lambda: scenes.gltf(**name, export_format="GLTF_SEPARATE"),
        ".fbx": lambda: scenes.fbx(**name),
        ".usd": lambda: files.usd_export(**name),
        ".usda": lambda: files.usd_export(**name),
        ".usdc": lambda: files.usd_export(**name),
        ".usdz": lambda: files.usd_export(**name),
        ".blend": lambda: files.save_as_mainfile(**name, copy=True),
    }
    with warnings.catch_warnings():
        # The FBX exporter of Blender 5.2 does what NumPy 2.5 advises against.
        warnings.simplefilter("ignore", DeprecationWarning)
        exporters[path.suffix]()
    return path


def world_vertices(obj):
    return set(map(tuple, in_scene(obj).round(4)))


@pytest.mark.parametrize("ending", MESH_ENDINGS)
def test_each_kind_of_file_is_read_upright(tmp_path, ending):
    path = write_wedge(tmp_path / f"wedge{ending}")
    (obj,) = load(path, "Z" if ending == ".off" else None)
    assert world_vertices(obj) == set(VERTICES)


def test_the_up_axis_can_be_chosen(tmp_path):
    (obj,) = load(write_wedge(tmp_path / "wedge.ply"), "Y")
    assert world_vertices(obj) == {(x, -z, y) for x, y, z in VERTICES}


def test_the_ending_may_be_in_capitals(tmp_path):
    write_wedge(tmp_path / "wedge.stl").rename(tmp_path / "WEDGE.STL")
    assert load(tmp_path / "WEDGE.STL")


def test_off_headers(tmp_path):
    for header in (
        "OFF 6 5 0",
        "OFF6 5 0",
        "# Å\n\nOFF # b\n6 5",
        "\ufeffCOFF\n6 5 0",
        "NOFF\n6 5 0",
    ):
        write_off(tmp_path / "wedge.off", header)
        (obj,) = load(tmp_path / "wedge.off", "Z")
        assert [tuple(p.vertices) for p in obj.data.polygons] == FACES, header


def test_off_may_have_colors(tmp_path):
    vertices = "0 0 0 9 9 9 255\n1 0 0 9 9 9 255\n0 1 0 9 9 9 255\n"
    (tmp_path / "a.off").write_text(f"COFF\n3 1 0\n{vertices}3 0 1 2 9 9 9\n")
    (obj,) = load(tmp_path / "a.off")
    assert [tuple(p.vertices) for p in obj.data.polygons] == [(0, 1, 2)]


def test_bad_off(unexpected):
    cases = [
        ("hello", "does not begin like an OFF file"),
        ("4OFF\n3 1 0\n", "does not begin like an OFF file"),
        ("OFF BINARY\n", "does not state its numbers"),
        ("OFF\n", "does not state its numbers"),
        ("OFF\n\u00b3 1 0\n", "does not state its numbers"),
        (f"OFF\n{'9' * 5000} 1 0\n", "does not state its numbers"),
        ("OFF\n900000000 1 0\n0 0 0\n", "is truncated"),
        ("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n", "is truncated"),
        ("OFF\n3 1 0\n0 0 0\n1 0\n0 1 0\n3 0 1 2\n", "not three numbers"),
        ("OFF\n3 1 0\n0 0 0\n1 0 x\n0 1 0\n3 0 1 2\n", "not three numbers"),
        ("OFF\n3 1 0\n0 0 0\n1_0 0 0\n0 1 0\n3 0 1 2\n", "words where numbers"),
        ("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 0_2\n", "words where numbers"),
        ("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1\n", "corners are not whole"),
        ("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "does not have"),
        ("OFF\n3 1 0\n0 0 nan\n1 0 0\n0 1 0\n3 0 1 2\n", "not finite"),
    ]
    files = {
        f"{number}.off": (text.encode("latin-1"), message)
        for number, (text, message) in enumerate(cases)
    }
    assert unexpected(files) == {}


@pytest.mark.parametrize("ending", sorted(set(MESH_ENDINGS) - {".obj"}))
def test_files_cut_short_are_refused(tmp_path, unexpected, ending):
    path = write_wedge(tmp_path / f"wedge{ending}")
    data = path.read_bytes()
    for share in (0.05, 0.5, 0.98):
        cut = data[: int(len(data) * share)]
        assert unexpected({path.name: (cut, "wedge.")}) == {}, share


@pytest.mark.parametrize("ending", READ_ENDINGS)
def test_files_of_another_kind_are_refused(tmp_path, ending):
    path = tmp_path / f"a{ending}"
    for content in (b"", b"hello\n" * 50, bytes(range(256)) * 20):
        path.write_bytes(content)
        with pytest.raises(DecompositionError, match=rf"^{path} (is|has|cannot|does)"):
            load(path)


def test_missing_files_folders_and_unknown_endings(tmp_path):
    with pytest.raises(DecompositionError, match=r"cannot be read \(File name too"):
        load(tmp_path / f"{'a' * 300}.obj")
    with pytest.raises(DecompositionError, match="does not exist"):
        load(tmp_path / "a.obj")
    (tmp_path / "folder.obj").mkdir()
    with pytest.raises(DecompositionError, match="is a folder"):
        load(tmp_path / "folder.obj")
    (tmp_path / "a.3ds").write_text("x")
    with pytest.raises(DecompositionError, match=r"these are: \.obj \.ply"):
        load(tmp_path / "a.3ds")


def test_obj_cut_within_a_line(tmp_path):
    (tmp_path / "a.obj").write_text(
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2"
    )
    with pytest.raises(DecompositionError, match="stops within a line"):
        load(tmp_path / "a.obj")


def test_obj_faces_without_their_vertices(tmp_path, unexpected):
    triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
    faces = (
        "f 1 2 4",
        "f 0 1 2",
        "f -1 -2 -4",
        "f 1/1 2/1 9/1",
        "f 1 2 \\\n4",
        "f 1 2 4\nv 0 0 1",
        f"f 1 2 {'9' * 5000}",
    )
    cases = {
        f"{number}.obj": (f"{triangle}{face}\n".encode(), "has a face that")
        for number, face in enumerate(faces)
    }
    assert unexpected(cases) == {}
    (tmp_path / "a.obj").write_text(triangle + "v 0 0 1\nf -1/9 1 2//1 # 99\n")
    assert len(load(tmp_path / "a.obj")[0].data.polygons) == 2


def test_wires_are_refused(tmp_path):
    (tmp_path / "a.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2\nl 2 3\n")
    with pytest.raises(DecompositionError, match="has edges but no faces"):
        load(tmp_path / "a.obj")


def test_a_blend_file_without_meshes(tmp_path):
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "a.blend"), copy=True)
    with pytest.raises(DecompositionError, match="has no meshes or point clouds"):
        load(tmp_path / "a.blend")


def test_gltf_without_its_buffer(tmp_path):
    path = write_wedge(tmp_path / "wedge.gltf")
    path.with_suffix(".bin").unlink()
    with pytest.raises(DecompositionError, match=r"cannot be read as \.gltf"):
        load(path)


TRIANGLE = [0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1]
NOT_FINITE = {
    "text.obj": b"v 0 0 0\nv 1 0 -NaN\nv 0 1 0\nf 1 2 3\n",
    "large.obj": b"v 0 0 0\nv 1 0 1e999\nv 0 1 0\nf 1 2 3\n",
    "continued.obj": b"v 0 0 0\nv 1 0 \\\n1e39\nv 0 1 0\nf 1 2 3\n",
    "digits.obj": b"v 0 0 0\nv 1 0 %s\nv 0 1 0\nf 1 2 3\n" % (b"9" * 40),
    "ind.obj": b"v 0 0 0\nv 1 0 -nan(ind)\nv 0 1 0\nf 1 2 3\n",
    "text.stl": b"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 inf\n"
    b"vertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\n",
    "binary.stl": bytes(80) + struct.pack("<I12fH", 1, *TRIANGLE, float("nan"), 0),
    "large.stl": b"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 -1e+999\n"
    b"vertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\n",
    "large.ply": PLY.format("ascii", XYZ).encode()
    + b"0 0 0\n1 1E999 0\n0 1 0\n3 0 1 2\n",
    "text.ply": PLY.format("ascii", XYZ).encode() + b"0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n",
    "binary.ply": PLY.format("binary_big_endian", NORMAL + XYZ).encode()
    + struct.pack(">12f", *TRIANGLE, float("inf"))
    + struct.pack(">B3i", 3, 0, 1, 2),
}


def test_coordinates_that_are_not_numbers(unexpected):
    cases = {name: (data, "not finite") for name, data in NOT_FINITE.items()}
    assert unexpected(cases) == {}


def test_large_numbers_words_and_comments_are_no_infinities(tmp_path):
    path = tmp_path / "a.obj"
    path.write_text(
        "# info 1e999\no inf 1e999\nv 1e-999 1e20 0.000000000000000000001\n"
        "v 1 0 1e+18 # nan\nv 0 1 0\nf 1 2 3\n"
    )
    assert len(load(path)[0].data.polygons) == 1


def test_normals_may_be_no_numbers(tmp_path):
    header = PLY.format("ascii", NORMAL + XYZ)
    (tmp_path / "a.ply").write_text(
        header + "nan 0 0 0\nnan 1 0 0\nnan 0 1 0\n3 0 1 2\n"
    )
    assert load(tmp_path / "a.ply")


def test_the_users_extensions_stay_enabled(tmp_path):
    load(write_wedge(tmp_path / "wedge.obj"))
    assert hasattr(bpy.types, "WCD_OT_decompose")
