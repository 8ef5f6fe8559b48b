"""A hull that is active is named as one; what was joined to it is an object."""

import bpy
import pytest
from hand_made import activate
from weak_convex_decomposition.operators.bridge.hulls.listed import hulls_of

QUICK = {"max_hulls": 1, "max_error": 1.0, "error_unit": "SCENE"}


@pytest.fixture
def hull(suzanne):
    """Return the hull of an object, the only selected one."""
    bpy.ops.wcd.build_hulls(**QUICK)
    (hull,) = hulls_of(suzanne)
    activate(hull)
    return hull


@pytest.mark.parametrize("name", ["decompose", "build_hulls", "remove_hulls"])
def test_nothing_is_made_for_a_hull(suzanne, hull, name):
    operator = getattr(bpy.ops.wcd, name)
    with pytest.raises(
        RuntimeError, match=r"hull 01 is a hull of Suzanne; select that"
    ):
        operator()
    assert list(hull.keys()) == ["wcd_hull"]
    suzanne.select_set(True)
    assert operator.poll()


def test_an_object_that_was_joined_to_a_hull_is_decomposed(hull):
    bpy.ops.mesh.primitive_cube_add(location=(9, 0, 0))
    hull.select_set(True)
    bpy.context.view_layer.objects.active = hull
    bpy.ops.object.join()
    assert bpy.ops.wcd.decompose(samples=100, parts=2) == {"FINISHED"}
    assert len(hull.wcd_parts) == 2
