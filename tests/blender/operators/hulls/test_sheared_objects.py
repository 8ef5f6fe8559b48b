"""Objects that their parents shear are read as they are in the scene."""

import json
from math import pi

import bpy
import numpy as np
import pytest
import weak_convex_decomposition as wcd
from edited import record_of
from hand_made import activate, build_hulls, in_scene, mesh_object
from headless.command import run_wcd
from mathutils import Matrix
from weak_convex_decomposition.core.errors import DecompositionError
from weak_convex_decomposition.operators.bridge.read.extents import half_side_of
from weak_convex_decomposition.operators.bridge.read.shape import (
    has_proportions_of,
    read_shape,
    scene_unit,
)
from weak_convex_decomposition.operators.viewport import sight_overlay

TURN, LONG = Matrix.Rotation(pi / 4, 4, "Y"), Matrix.Diagonal((1, 1, 6, 1))


def dented_block(name, matrix):
    """Return a block of 8 by 8 by 1, moved by a matrix; its dent is 0.25 deep."""
    outer = [(-4, -4), (4, -4), (4, 4), (-4, 4)]
    sides = [(k, (k + 1) % 4, (k + 1) % 4 + 4, k + 4) for k in range(4)]
    walls = [[corner + up for corner in side] for up in (0, 4) for side in sides]
    places = [(*p, z) for z in (0, 1) for p in outer]
    places += [(0.875 * x, 0.875 * y, 0.75) for x, y in outer]
    obj = mesh_object(name, places, [(3, 2, 1, 0), *walls, (8, 9, 10, 11)])
    obj.data.transform(matrix)
    return obj


def below(obj, scale=(1, 1, 6), turn=-pi / 4):
    """Turn an object within a parent that is longer along an axis; return it."""
    obj.parent, obj.rotation_euler.y = new_parent(), turn
    obj.parent.scale, obj.parent.rotation_euler.z = scale, 0.3
    bpy.context.view_layer.update()
    return obj


def new_parent():
    parent = bpy.data.objects.new("Parent", None)
    bpy.context.collection.objects.link(parent)
    return parent


@pytest.fixture
def sheared():
    return below(dented_block("Sheared", TURN))


def upright():
    """Return the same solid, whose parent takes back the shear of its mesh.

    It is read with its sides along the axes: then rounding moves no cut.
    """
    return unsheared(dented_block("Upright", LONG))


def unsheared(obj):
    """Let a parent shear an object, and its mesh take that back; return the object.

    No number is rounded.
    """
    obj.parent = new_parent()
    shear = Matrix(((1.25, 0, 0.75), (0, 1, 0), (0.75, 0, 1.25))).to_4x4()
    obj.matrix_parent_inverse = shear
    obj.data.transform(shear.inverted())
    bpy.context.view_layer.update()
    return obj


def distances(points):
    return np.linalg.norm(points[:, None] - points, axis=2)


@pytest.mark.parametrize("scale", [(1, 1, 6), (-2, 1, 0.3)])
def test_all_distances_are_those_in_the_scene(scale):
    obj = below(dented_block("Block", TURN), scale)
    mesh = read_shape(obj)
    found = distances(mesh.vertices) * scene_unit(obj)
    assert found == pytest.approx(distances(in_scene(obj)), rel=1e-5)
    a, b, c = (mesh.vertices[mesh.triangles[:, i]] for i in range(3))
    volume = np.einsum("ij,ij->", a, np.cross(b, c)) / 6  # the faces point outwards
    assert volume == pytest.approx(64 - 16 * (1 + 0.875 + 0.875**2) / 3, rel=1e-5)


@pytest.mark.parametrize("unit", ["RELATIVE", "SCENE"])
def test_a_solid_has_the_same_hulls_however_it_is_built(unit):
    options = {"error_unit": unit, "max_error": 0.1 if unit == "RELATIVE" else 0.4}
    sheared, plain = upright(), dented_block("Plain", LONG)
    one, other = (wcd.build_hulls(obj, **options) for obj in (sheared, plain))
    assert one.n_hulls == other.n_hulls > 1
    assert one.errors == pytest.approx(other.errors, rel=1e-3)
    assert one.half_side == pytest.approx(4, rel=1e-5)
    assert half_side_of(sheared, "ORIGINAL") == pytest.approx(4, rel=1e-5)
    build_hulls([sheared], **options)
    record = record_of(sheared)["hulls"]
    errors = [hull["error"] for hull in record["hulls"]]
    assert errors == pytest.approx(one.errors.tolist())


def test_the_longest_side_is_that_along_the_axes_of_the_object(sheared):
    half = wcd.build_hulls(sheared, max_hulls=1).half_side
    assert half == pytest.approx((8 + 6) / 2**1.5, rel=1e-5)
    assert half_side_of(sheared, "ORIGINAL") == pytest.approx(half, rel=1e-5)
    sheared.modifiers.new("Row", "ARRAY")
    bpy.context.view_layer.update()
    assert half_side_of(sheared, "ORIGINAL") == pytest.approx(half, rel=1e-5)
    assert half_side_of(sheared, "EVALUATED") is None


def test_the_error_is_the_depth_of_the_dent(sheared):
    found = wcd.build_hulls(sheared, max_hulls=1, error_unit="SCENE", max_error=0.1)
    assert found.errors == pytest.approx([1.5], rel=0.1)


@pytest.mark.parametrize("kind", ["HULL", "BOX", "SPHERE", "CYLINDER", "CAPSULE"])
def test_hulls_lie_around_the_object(sheared, kind):
    (hull,) = build_hulls([sheared], max_hulls=1, shape="BOX")
    activate(sheared)
    bpy.ops.wcd.refit_hull(hull=hull.name, shape=kind)
    (hull,) = (obj for obj in sheared.children if obj.name.startswith("Sheared hull"))
    hull.data.calc_loop_triangles()
    places = in_scene(hull)
    a, b, c = (
        places[[each.vertices[i] for each in hull.data.loop_triangles]]
        for i in range(3)
    )
    normals = np.cross(b - a, c - a)
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    above = np.einsum("tk,vtk->vt", normals, in_scene(sheared)[:, None] - a)
    round_kind = kind not in {"HULL", "BOX"}
    assert above.max() <= (0.3 if round_kind else 1e-4)
    if kind == "SPHERE":
        away = np.linalg.norm(places - places.mean(axis=0), axis=1)
        assert np.ptp(away) < 1e-3 * away.max()


def told_of(path, *options):
    """Save the file, build hulls of it; return what is told of each object by name."""
    bpy.ops.wm.save_as_mainfile(filepath=str(path), copy=True)
    report = path.with_name("r.json")
    words = [path, "--hulls", path.with_name("h.obj"), "--report", report, *options]
    assert run_wcd(*words, "--quiet") == 0
    (entry,) = json.loads(report.read_text())["inputs"]
    return {each["name"]: each["hulls"]["hulls"] for each in entry["objects"]}


def test_the_command_line_agrees(tmp_path):
    obj = upright()
    found = wcd.build_hulls(obj, max_error=0.1)
    hulls = told_of(tmp_path / "s.blend", "--max-error", "0.1")["Upright"]
    errors = [hull["error"] for hull in hulls]
    assert errors == pytest.approx(found.errors.tolist(), rel=1e-3)
    (box,) = told_of(tmp_path / "b.blend", "--max-hulls", "1", "--shape=box")["Upright"]
    assert sorted(box["size"]["extents"]) == pytest.approx([6, 8, 8], rel=1e-4)


def test_a_sheared_and_a_plain_torus_share_no_hulls(tmp_path):
    bpy.ops.mesh.primitive_torus_add(major_radius=2, minor_radius=0.5)
    torus = below(bpy.context.active_object)
    other = bpy.data.objects.new("Plain", torus.data)
    other.scale = torus.matrix_world.to_scale()
    twin = bpy.data.objects.new("Twin", torus.data)
    for obj in (other, twin):
        bpy.context.collection.objects.link(obj)
    twin.parent, twin.rotation_euler.y = torus.parent, -pi / 4
    bpy.context.view_layer.update()
    assert has_proportions_of(torus, twin)
    assert not has_proportions_of(torus, other)
    assert not has_proportions_of(other, torus)
    told = told_of(tmp_path / "in.blend", "--max-hulls", "1")
    errors = {name: [hull["error"] for hull in told[name]] for name in told}
    assert errors["Torus"] == errors["Twin"] != errors["Plain"]


def test_lines_of_sight_begin_on_the_face(sheared):
    bpy.ops.wcd.show_sight(face=0, samples=100)
    overlay = sight_overlay.current
    point = np.linalg.solve(overlay.stretch, overlay.view.point)
    middle = sheared.data.polygons[0].center
    assert point == pytest.approx(np.array(middle), abs=1e-2)


def test_faces_of_a_sheared_object_are_cut_where_those_of_a_plain_one_are():
    outline = [(0, 0), (5, 0), (5, 1), (1, 1), (1, 4), (0, 4)]
    places = [(*p, z) for z in (0, 1) for p in outline]
    walls = [(i, (i + 1) % 6, (i + 1) % 6 + 6, i + 6) for i in range(6)]
    faces = [range(6, 12), range(5, -1, -1), *walls]
    plain, cut = mesh_object("Plain", places, faces), []
    for obj in (plain, unsheared(mesh_object("L", places, faces))):
        activate(obj)
        bpy.ops.wcd.decompose(samples=200, parts=2, seams="CUT")
        cut.append(distances(in_scene(obj)))
    assert len(cut[0]) > 12
    assert np.sort(cut[1].ravel()) == pytest.approx(np.sort(cut[0].ravel()), abs=1e-3)


def test_a_flat_sheared_object_is_refused():
    obj = below(dented_block("Flat", Matrix()), scale=(1, 1, 0))
    with pytest.raises(DecompositionError, match="scale is zero along an axis"):
        read_shape(obj)
