"""How hulls are seen, removing them, and changing one of them."""

import bpy
import numpy as np
import pytest
from edited import record_of
from hand_made import decompose_by_hand
from snapshot import snapshot
from weak_convex_decomposition.operators.bridge.hulls.listed import hulls_of
from weak_convex_decomposition.ui import sidebar

QUICK = {"max_hulls": 3, "max_error": 0.2}


def build(**values):
    bpy.context.scene.wcd.samples = 100
    bpy.ops.wcd.build_hulls(**{**QUICK, **values})
    return hulls_of(bpy.context.active_object)


def noted(obj):
    return {hull["name"]: hull for hull in record_of(obj)["hulls"]["hulls"]}


@pytest.fixture
def built(suzanne):
    """Return an object with parts and a hull around each."""
    decompose_by_hand(suzanne, 3)
    build(pieces="PARTS")
    return suzanne


def test_hulls_are_seen_through_and_the_parts_are_not(built):
    hulls = hulls_of(built)
    for hull in hulls:
        seen, own = hull.material_slots[0].material, hull.data.materials[0]
        assert seen.diffuse_color[3] < 0.5 < own.diffuse_color[3] == 1.0
        assert tuple(seen.diffuse_color)[:3] == tuple(own.diffuse_color)[:3]
        assert hull.color[3] < 0.5
    n_materials = len(bpy.data.materials)
    bpy.context.scene.wcd.look = "WIRE"
    assert {hull.display_type for hull in hulls} == {"WIRE"}
    assert len(bpy.data.materials) == n_materials - len(hulls)
    bpy.ops.wcd.show_hulls(look="SOLID")
    assert {hull.display_type for hull in hulls} == {"TEXTURED"}
    assert all(hull.material_slots[0].link == "DATA" for hull in hulls)
    bpy.context.scene.wcd.look = "TRANSPARENT"
    assert len(bpy.data.materials) == n_materials


def test_remove_hulls_leaves_parts_and_other_children(suzanne):
    decompose_by_hand(suzanne, 3)
    mine = bpy.data.objects.new("mine", None)
    mine.parent = suzanne
    bpy.context.collection.objects.link(mine)
    before, objects = snapshot(suzanne), bpy.data.objects[:]
    materials = bpy.data.materials[:]
    build(pieces="PARTS")
    bpy.ops.wcd.remove_hulls()
    assert snapshot(suzanne) == before
    assert bpy.data.objects[:] == objects
    assert bpy.data.materials[:] == materials
    assert not bpy.ops.wcd.remove_hulls.poll()


def test_one_hull_is_removed(built):
    names = list(noted(built))
    bpy.ops.wcd.remove_hull(hull=names[1])
    assert list(noted(built)) == [names[0], names[2]]
    assert [hull.name for hull in hulls_of(built)] == [names[0], names[2]]
    with pytest.raises(RuntimeError, match="has no hull nothing"):
        bpy.ops.wcd.remove_hull(hull="nothing")
    for operator in (bpy.ops.wcd.remove_hull, bpy.ops.wcd.refit_hull):
        with pytest.raises(RuntimeError, match="Name a hull of Suzanne: `hull` is"):
            operator(hull="")
    for name in (names[0], names[2]):
        bpy.ops.wcd.remove_hull(hull=name)
    assert "hulls" not in record_of(built)
    assert "Suzanne hulls" not in bpy.data.collections


@pytest.mark.parametrize("shape", ["BOX", "SPHERE", "CAPSULE"])
def test_one_hull_gets_the_shape_that_it_would_have_been_built_with(suzanne, shape):
    decompose_by_hand(suzanne, 3)
    suzanne.scale = (1, 2, 1)
    bpy.context.view_layer.update()
    build(pieces="PARTS", shape=shape)
    expected, ratio = noted(suzanne), record_of(suzanne)["hulls"]["volume_ratio"]
    build(pieces="PARTS", shape="CYLINDER")
    for name in list(noted(suzanne)):
        bpy.ops.wcd.refit_hull(hull=name, shape=shape)
    found = noted(suzanne)
    by_part = {hull["part"]: hull for hull in found.values()}
    for hull in expected.values():
        other = by_part[hull["part"]]
        assert (other["kind"], other["vertices"]) == (shape, hull["vertices"])
        assert other["volume"] == pytest.approx(hull["volume"], rel=1e-4)
        assert other["error"] == pytest.approx(hull["error"], rel=0.1)
    assert record_of(suzanne)["hulls"]["volume_ratio"] == pytest.approx(ratio, rel=1e-3)
    assert len(hulls_of(suzanne)) == 3


@pytest.mark.parametrize("margin", [0.0, 0.1])
def test_a_hull_comes_back_after_other_shapes(built, margin):
    build(pieces="PARTS", margin=margin)
    hull, *others = hulls_of(built)
    before = [tuple(vertex.co) for vertex in hull.data.vertices]
    meshes = [other.data for other in others]
    name = hull.name
    for shape in ("SPHERE", "HULL", "BOX", "HULL"):
        bpy.ops.wcd.refit_hull(hull=name, shape=shape)
        assert noted(built)[name]["kind"] == shape
    after = [tuple(vertex.co) for vertex in hulls_of(built)[0].data.vertices]
    assert np.allclose(sorted(after), sorted(before), atol=1e-4)
    assert [other.data for other in hulls_of(built)[1:]] == meshes


def test_a_renamed_hull_is_listed_and_keeps_its_name(built):
    hull = hulls_of(built)[0]
    figures = noted(built)[hull.name]
    hull.name = "Mine"
    assert sidebar.hull_rows_of(built)[0] == {
        **figures,
        "name": "Mine",
        "object": hull,
    }
    bpy.ops.wcd.refit_hull(hull="Mine", shape="BOX")
    assert len(sidebar.hull_rows_of(built)) == 3
    assert noted(built)["Mine"]["kind"] == "BOX"
    hull.name = "Mine again"
    bpy.ops.wcd.remove_hull(hull="Mine again")
    assert len(noted(built)) == len(sidebar.hull_rows_of(built)) == 2


def test_a_copy_of_a_hull_is_not_listed_and_stays(built):
    hull = hulls_of(built)[0]
    copy = hull.copy()
    copy.data = hull.data.copy()
    bpy.context.collection.objects.link(copy)
    mesh, before = copy.data, built["wcd"]
    assert len(sidebar.hull_rows_of(built)) == 3
    with pytest.raises(RuntimeError, match="is not in the list of Suzanne's hulls"):
        bpy.ops.wcd.refit_hull(hull=copy.name, shape="BOX")
    assert copy.data == mesh
    assert built["wcd"] == before


def test_unreal_names_follow_the_shape(suzanne):
    build(naming="UNREAL", max_hulls=1)
    bpy.ops.wcd.refit_hull(hull="UCX_Suzanne_01", shape="BOX")
    assert [hull.name for hull in hulls_of(suzanne)] == list(noted(suzanne))
    assert hulls_of(suzanne)[0].name.startswith("UBX_")


def test_each_part_may_have_a_shape_of_its_own(suzanne):
    decompose_by_hand(suzanne, 3)
    suzanne.wcd_parts[0].hull_shape = "BOX"
    suzanne.wcd_parts[2].hull_shape = "SPHERE"
    build(pieces="PARTS")
    kinds = {hull["part"]: hull["kind"] for hull in noted(suzanne).values()}
    assert kinds == {0: "BOX", 1: "HULL", 2: "SPHERE"}
    bpy.ops.wcd.decompose(samples=100, parts=3)
    assert "BOX" in {row.hull_shape for row in suzanne.wcd_parts}


def test_boxes_have_six_quads(suzanne):
    (hull,) = build(shape="BOX", max_hulls=1)
    assert [len(face.vertices) for face in hull.data.polygons] == [4] * 6
    middle = sum((v.co for v in hull.data.vertices), start=hull.data.vertices[0].co * 0)
    for face in hull.data.polygons:
        assert face.normal.dot(face.center - middle / 8) > 0


def test_linked_copies_of_a_hull_stay(built):
    hull = hulls_of(built)[0]
    copy = hull.copy()
    bpy.context.collection.objects.link(copy)
    copy.parent = None
    mesh = copy.data
    bpy.ops.wcd.refit_hull(hull=hull.name, shape="BOX")
    assert (copy.data, len(hull.data.vertices)) == (mesh, 8)


def test_a_hull_without_material_gets_another_shape(built):
    hull = hulls_of(built)[0]
    hull.data.materials.clear()
    bpy.ops.wcd.refit_hull(hull=hull.name, shape="BOX")
    assert (len(hull.data.vertices), len(hull.data.materials)) == (8, 0)


def test_a_hull_keeps_its_name_after_another_is_removed(built):
    first, second, _ = (hull.name for hull in hulls_of(built))
    bpy.ops.wcd.remove_hull(hull=first)
    bpy.ops.wcd.refit_hull(hull=second, shape="BOX")
    assert hulls_of(built)[0].name == second
    assert noted(built)[second]["kind"] == "BOX"


def test_a_hull_of_an_object_with_a_long_name_stays_listed(suzanne):
    suzanne.name = "A" * 60
    build(max_hulls=1)
    hull = hulls_of(suzanne)[0]
    bpy.ops.wcd.refit_hull(hull=hull.name, shape="BOX")
    assert list(noted(suzanne)) == [hull.name]


@pytest.mark.parametrize("look", ["WIRE", "SOLID", "TRANSPARENT"])
def test_another_shape_is_seen_as_the_hull_was(built, look):
    bpy.ops.wcd.show_hulls(look=look)
    hull = hulls_of(built)[0]
    before = hull.display_type, hull.color[3], hull.material_slots[0].link
    bpy.ops.wcd.refit_hull(hull=hull.name, shape="BOX")
    after = hull.display_type, hull.color[3], hull.material_slots[0].link
    assert after == before


@pytest.mark.parametrize("look", ["SOLID", "TRANSPARENT"])
def test_a_hull_follows_the_color_and_name_of_its_part(built, look):
    bpy.ops.wcd.show_hulls(look=look)
    opacity = hulls_of(built)[0].color[3]
    built.wcd_parts[0].color = (1, 0, 0)
    built.wcd_parts[0].name = "Head"
    hull = next(h for h in hulls_of(built) if h.color[:3] == (1, 0, 0))
    seen = hull.material_slots[0].material
    assert tuple(seen.diffuse_color) == pytest.approx((1, 0, 0, opacity))
    assert seen.name.startswith("Head")
    assert hull.color[3] == pytest.approx(opacity)
    assert not any(material.users == 0 for material in bpy.data.materials)


def test_a_material_that_the_user_gave_a_hull_stays(built):
    mine, hull = bpy.data.materials.new("Mine"), hulls_of(built)[0]
    hull.material_slots[0].material = mine
    for look in ("SOLID", "TRANSPARENT"):
        bpy.ops.wcd.show_hulls(look=look)
        assert hull.material_slots[0].material == mine


def test_a_hull_of_a_library_takes_no_name(suzanne, tmp_path):
    build(max_hulls=1)
    path = str(tmp_path / "library.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path, copy=True)
    bpy.ops.wcd.clear()
    with bpy.data.libraries.load(path, link=True) as (_, wanted):
        wanted.objects = ["Suzanne hull 01"]
    assert [hull.name for hull in build(max_hulls=1)] == ["Suzanne hull 01"]
