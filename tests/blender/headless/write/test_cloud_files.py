"""Point clouds are written in the colors of their parts, those given by hand too."""

import bpy
import clouds
import numpy as np
import pytest
import shapes
import trimesh
from hand_made import activate, mesh_object
from weak_convex_decomposition.core.errors import DecompositionError
from weak_convex_decomposition.operators.bridge.mesh.attributes import write_attribute
from weak_convex_decomposition.operators.bridge.parts.read import part_labels
from weak_convex_decomposition.operators.headless.write.model_files import save

COLOR = (0.25, 0.5, 0.75)
SRGB = (137, 188, 225)  # the same in sRGB, of 255


@pytest.fixture
def recolored():
    """Return a cloud of two parts; the second has a color given by hand."""
    points, normals = clouds.drawn(shapes.dumbbell(), 900)
    obj = mesh_object("points", points, [])
    write_attribute(obj.data, "normal", "FLOAT_VECTOR", "POINT", normals)
    activate(obj)
    bpy.ops.wcd.decompose(samples=200, parts=2)
    obj.wcd_parts[1].color = COLOR
    return obj


def test_usd_has_colors_given_by_hand(tmp_path, recolored):
    save(tmp_path / "a.usd", None)
    lines = (tmp_path / "a.usd").read_text(encoding="utf-8").splitlines()
    (painted,) = [line for line in lines if "displayColor" in line]
    assert painted.count("(0.25, 0.5, 0.75)") == (part_labels(recolored) == 1).sum() > 0


def test_ply_has_colors_given_by_hand(tmp_path, recolored):
    save(tmp_path / "a.ply", None)
    colors = trimesh.load(tmp_path / "a.ply").colors[:, :3].astype(int)
    given = np.abs(colors - SRGB).max(axis=1) <= 1
    assert given.tolist() == (part_labels(recolored) == 1).tolist()


def test_glb_has_points_colors_and_part_numbers(tmp_path, recolored, checked_glb):
    before, name = recolored.data, recolored.data.name
    names = set(bpy.data.meshes.keys())
    assert save(tmp_path / "a.glb", None) == ()
    assert (recolored.data, before.name) == (before, name)
    assert set(bpy.data.meshes.keys()) == names
    scene, arrays = checked_glb(tmp_path / "a.glb")
    (mesh,) = (each for each in scene["meshes"] if each["name"] == name)
    attributes = mesh["primitives"][0]["attributes"]
    numbers = arrays[attributes["_PART"]]
    assert numbers.ravel().tolist() == part_labels(recolored).tolist()
    if bpy.app.version < (5, 0, 0):
        assert "COLOR_0" not in attributes  # they would be damaged
        return
    colors = arrays[attributes["COLOR_0"]]
    whole = 1.0 if colors.dtype.kind == "f" else np.iinfo(colors.dtype).max
    given = np.abs(colors[:, :3] / whole - COLOR).max(axis=1) < 1e-4
    assert given.tolist() == (part_labels(recolored) == 1).tolist()


@pytest.mark.parametrize("ending", [".obj", ".fbx"])
def test_formats_without_parts_of_points_say_so(tmp_path, recolored, ending):
    (note,) = save(tmp_path / f"a{ending}", None)
    assert note.startswith(f"points is a point cloud: {ending} does not hold its parts")


@pytest.mark.parametrize("ending", [".obj", ".fbx"])
def test_a_mesh_without_points_is_no_cloud(tmp_path, ending):
    mesh_object("empty", [], [])
    bpy.ops.mesh.primitive_cube_add()
    assert save(tmp_path / f"a{ending}", None) == ()


if bpy.app.version >= (5, 0, 0):  # 4.2 makes no point cloud objects

    @pytest.mark.parametrize("ending", [".obj", ".fbx", ".glb"])
    def test_formats_without_point_cloud_objects_say_so(tmp_path, recolored, ending):
        bpy.ops.wcd.clear()
        bpy.ops.object.convert(target="POINTCLOUD")
        path = tmp_path / f"a{ending}"
        with pytest.raises(
            DecompositionError, match=f"and {ending} files hold none; write"
        ):
            save(path, None)
        assert not path.exists()
        bpy.ops.mesh.primitive_cube_add()
        (note,) = save(path, None)
        assert f"is a point cloud object, which {ending} does not hold: it was" in note


@pytest.mark.parametrize("ending", [".ply", ".usd", ".glb"])
@pytest.mark.parametrize(
    ("kind", "domain"), [("INT", "POINT"), ("FLOAT_COLOR", "FACE")]
)
def test_attributes_of_the_user_are_no_parts(tmp_path, ending, kind, domain):
    obj = mesh_object("points", clouds.drawn(shapes.dumbbell(), 99)[0], [])
    if domain == "FACE":
        bpy.ops.mesh.primitive_cube_add()
        obj = bpy.context.active_object
    values = obj.data.attributes.new("wcd_part", kind, domain).data
    if kind == "INT":
        values[0].value, values[1].value = -5, 2**31 - 1
    assert save(tmp_path / f"a{ending}", None) == ()
