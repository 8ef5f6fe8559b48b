"""Clear removes hulls whose object is gone from the file, and none of anybody else."""

import bmesh
import bpy
import pytest
from hand_made import activate, build_hulls, decompose_by_hand, mesh_object
from weak_convex_decomposition.operators.bridge.hulls.listed import hulls_of

QUICK = {"max_hulls": 1, "max_error": 1.0}


def box(name, x):
    """Return a new cube with one hull, and the hull."""
    bpy.ops.mesh.primitive_cube_add(location=(x, 0, 0))
    cube = bpy.context.active_object
    cube.name = name
    (hull,) = build_hulls([cube], **QUICK)
    return cube, hull


def join(target, *others):
    activate(target)
    for other in others:
        other.select_set(True)
    bpy.ops.object.join()


def clear(obj):
    activate(obj)
    return bpy.ops.wcd.clear()


def left():
    """Return the names of the hulls and of the collections of ours in the file."""
    kinds = (bpy.data.objects, bpy.data.collections)
    return sorted(each.name for kind in kinds for each in kind if "wcd_hull" in each)


@pytest.fixture
def joined():
    """Two boxes with hulls, joined to one object, and the hull of the second one."""
    one, other = box("One", 0), box("Other", 5)
    join(one[0], other[0])
    assert other[1].parent is None
    return one[0], other[1]


@pytest.mark.parametrize("decomposed", [True, False])
def test_hulls_of_an_object_that_was_joined_go(joined, decomposed):
    if decomposed:
        decompose_by_hand(joined[0], 2)
    n_meshes, n_materials = len(bpy.data.meshes), len(bpy.data.materials)
    clear(joined[0])
    assert left() == []
    assert [obj.name for obj in bpy.data.objects] == ["One"]
    assert len(bpy.data.meshes) == n_meshes - 2
    assert len(bpy.data.materials) <= n_materials - 2


def test_an_object_without_anything_of_ours_can_be_cleared_of_them():
    bpy.ops.mesh.primitive_cube_add()
    plain = bpy.context.active_object
    activate(plain)
    assert not bpy.ops.wcd.clear.poll()
    join(plain, box("Other", 5)[0])
    assert bpy.ops.wcd.clear.poll()
    clear(plain)
    assert left() == []
    assert not bpy.ops.wcd.clear.poll()


@pytest.mark.parametrize("with_hulls", [False, True])
def test_another_object_may_have_the_name_of_the_one_that_is_gone(joined, with_hulls):
    activate(joined[0])
    bpy.ops.object.duplicate()
    namesake = bpy.context.active_object
    namesake.name = "Other"
    if not with_hulls:
        bpy.ops.wcd.clear()
    clear(joined[0])
    assert ("Other hull 01" in left()) == with_hulls  # it may be that one's
    if with_hulls:
        clear(namesake)
    assert left() == []


def test_undo_brings_them_back(joined):
    bpy.ops.ed.undo_push(message="joined")
    clear(joined[0])
    bpy.ops.ed.undo_push(message="cleared")
    bpy.ops.ed.undo()
    assert "Other hull 01" in left()


@pytest.mark.parametrize("where", ["hidden", "another scene", "no scene", "renamed"])
def test_hulls_of_an_object_that_is_there_stay(joined, where):
    owner, hull = box("Third", 9)
    if where == "hidden":
        owner.hide_set(True)
        hull.hide_set(True)
    elif where == "renamed":
        owner.name = "Another"
    else:
        collection = bpy.data.collections["Third hulls"]
        for each in (owner, collection):
            kind = "objects" if each == owner else "children"
            getattr(bpy.context.scene.collection, kind).unlink(each)
            if where == "another scene":
                other = bpy.data.scenes.get("Other") or bpy.data.scenes.new("Other")
                getattr(other.collection, kind).link(each)
        owner.use_fake_user = True
    clear(joined[0])
    assert hulls_of(owner) == [hull]
    assert left() == ["Third hull 01", "Third hulls"]


@pytest.mark.parametrize("taken", ["from its object", "and renamed", "and cleared"])
def test_hulls_that_the_user_took_from_their_object_stay(joined, taken):
    owner, hull = box("Third", 9)
    hull.parent = None
    if taken == "and renamed":
        hull.name = "Mine"
    if taken == "and cleared":
        clear(owner)
    clear(joined[0])
    assert bpy.data.objects[hull.name] == hull
    assert ("wcd_hull" in hull) == (taken != "and cleared")


@pytest.mark.parametrize("how", ["moved", "linked", "decomposed"])
def test_hulls_that_the_user_keeps_stay(joined, how):
    obj, hull = joined
    tagged = bpy.data.collections["Other hulls"]
    if how in {"moved", "linked"}:
        mine = bpy.data.collections.new("Mine")
        mine.objects.link(hull)
    if how == "moved":
        tagged.objects.unlink(hull)
    if how == "decomposed":
        decompose_by_hand(hull, 2)
    bpy.context.view_layer.update()  # Blender 4.2 may crash without
    clear(obj)
    assert "Other hull 01" in left()
    assert ("Other hulls" in left()) == (how != "moved")


def join_mine_to(hull):
    mine = mesh_object("mine", [(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])
    join(hull, mine)


def test_what_was_joined_into_a_hull_stays(joined):
    obj, hull = joined
    join_mine_to(hull)
    clear(obj)
    assert hull.name in left()


def test_a_hull_without_an_object_that_the_user_deleted_vertices_of_stays(joined):
    obj, hull = joined
    before = left()
    activate(hull)
    bpy.ops.object.mode_set(mode="EDIT")
    bm = bmesh.from_edit_mesh(hull.data)
    bm.verts.remove(next(iter(bm.verts)))
    bpy.ops.object.mode_set(mode="OBJECT")
    clear(obj)
    assert set(left()) == set(before) - {"One hull 01", "One hulls"}


def test_what_was_joined_into_the_hull_of_an_object_that_is_there_stays():
    obj, hull = box("One", 0)
    join_mine_to(hull)
    with pytest.raises(RuntimeError, match="There is an object One hull 01 already"):
        build_hulls([obj], **QUICK)
    assert hulls_of(obj) == [hull]  # nothing has changed
    hull.name = "Mine"
    (new,) = build_hulls([obj], **QUICK)
    assert hulls_of(obj) == [new]
    clear(obj)
    assert [each.name for each in obj.children] == ["Mine"]


def test_a_hull_with_fewer_vertices_is_a_hull_still():
    obj, hull = box("One", 0)
    hull.data = hull.data.copy()
    hull.data.clear_geometry()
    hull.data.from_pydata([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [], [(0, 1, 2)])
    clear(obj)
    assert left() == []


def test_the_users_objects_stay(joined):
    obj, _ = joined
    mine = mesh_object("mine", [(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])
    bpy.data.collections["Other hulls"].objects.link(mine)
    clear(obj)
    assert left() == ["Other hulls"]
    assert list(bpy.data.collections["Other hulls"].objects) == [mine]


def test_their_simulation_goes_too():
    one, other = box("One", 0)[0], box("Other", 5)[0]
    activate(other)
    bpy.ops.wcd.make_rigid()
    join(one, other)
    clear(one)
    assert bpy.context.scene.rigidbody_world is None
    assert left() == []


def test_a_part_that_got_the_hulls_of_its_object_can_be_cleared(suzanne):
    decompose_by_hand(suzanne, 2)
    build_hulls([suzanne], **QUICK)
    activate(suzanne)
    bpy.ops.wcd.separate()
    piece = bpy.data.objects["Suzanne Part 01"]
    for hull in hulls_of(suzanne):
        hull.parent = piece
    bpy.data.objects.remove(suzanne)
    bpy.context.view_layer.update()
    clear(piece)
    assert left() == []


def test_a_copy_of_a_hull_is_the_users():
    bpy.ops.mesh.primitive_monkey_add()
    obj = bpy.context.active_object
    bpy.ops.wcd.build_hulls(max_error=0.3)
    hull = obj.children[0]
    copy = hull.copy()
    copy.data = hull.data.copy()
    copy.name = "Mine"
    hull.users_collection[0].objects.link(copy)
    activate(obj)
    bpy.ops.wcd.build_hulls(max_error=0.2)
    assert "Mine" in bpy.data.objects
    bpy.ops.wcd.clear()
    assert obj.children[:] == (bpy.data.objects["Mine"],)
