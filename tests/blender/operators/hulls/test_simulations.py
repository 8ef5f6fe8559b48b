"""The simulation that we made goes, unless the user put work into it."""

import bpy
import pytest
from hand_made import activate

HULLS = {"max_hulls": 1, "max_error": 1.0}


@pytest.fixture
def body():
    """A cube that is a rigid body of its hull, and so made the simulation."""
    bpy.ops.mesh.primitive_cube_add()
    cube = bpy.context.active_object
    bpy.ops.wcd.build_hulls(**HULLS)
    bpy.ops.wcd.make_rigid()
    return cube


def world():
    return bpy.context.scene.rigidbody_world


def clear(obj):
    activate(obj)
    bpy.ops.wcd.clear()
    assert obj.rigid_body is None
    assert [each.name for each in bpy.data.objects if "wcd_hull" in each] == []


def set_weights(collection):
    weights = world().effector_weights
    weights.collection = bpy.data.collections.new("Wind") if collection else None
    weights.gravity = 1.0 if collection else 0.5


SETTINGS = {
    "speed": lambda: setattr(world(), "time_scale", 2.0),
    "steps": lambda: setattr(world(), "substeps_per_frame", 20),
    "iterations": lambda: setattr(world(), "solver_iterations", 30),
    "impulse": lambda: setattr(world(), "use_split_impulse", True),
    "off": lambda: setattr(world(), "enabled", False),
    "frames": lambda: setattr(world().point_cache, "frame_end", 500),
    "gravity": lambda: set_weights(False),
    "winds": lambda: set_weights(True),
}


@pytest.mark.parametrize("name", SETTINGS)
def test_a_simulation_with_other_settings_stays(body, name):
    SETTINGS[name]()
    clear(body)
    assert world() is not None
    assert list(world().collection.objects) == []


def test_a_simulation_that_ran_goes(body):
    for frame in range(1, 10):
        bpy.context.scene.frame_set(frame)
    clear(body)
    assert world() is None
    assert "RigidBodyWorld" not in bpy.data.collections


def test_settings_that_were_set_back_are_nobodys(body):
    world().time_scale = 2.0
    clear(body)
    bpy.ops.wcd.build_hulls(**HULLS)
    bpy.ops.wcd.make_rigid()
    assert world().time_scale == 2.0
    world().time_scale = 1.0
    clear(body)
    assert world() is None


def test_a_simulation_with_constraints_stays(body):
    bpy.ops.object.empty_add()
    hinge = bpy.context.active_object
    bpy.ops.rigidbody.constraint_add(type="HINGE")
    clear(body)
    assert list(world().constraints.objects) == [hinge]
    bpy.data.objects.remove(hinge)
    bpy.ops.wcd.build_hulls(**HULLS)
    bpy.ops.wcd.make_rigid()
    clear(body)
    assert world() is None


def test_a_simulation_with_bodies_in_a_collection_within_stays(body):
    mine = bpy.data.collections.new("Mine")
    world().collection.children.link(mine)
    mine.objects.link(bpy.data.objects.new("mine", bpy.data.meshes.new("mine")))
    clear(body)
    assert mine.name in world().collection.children


def test_a_simulation_that_nothing_is_noted_of_goes(body):
    world().collection["wcd_rigid"] = True
    clear(body)
    assert world() is None
