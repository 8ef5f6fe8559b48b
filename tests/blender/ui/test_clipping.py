"""What the Clipping Region (Alt B) leaves of lines and of surfaces that are clicked."""

import bpy
import numpy as np
import pytest
from stand_ins.presses import Pressed
from weak_convex_decomposition.core.steps.progress import run
from weak_convex_decomposition.operators.viewport import sight_overlay
from weak_convex_decomposition.operators.viewport.show_sight import WCD_OT_show_sight
from weak_convex_decomposition.ui.clipping import lines_within

# In front of both of these planes x is from 0 to 2.
BETWEEN = np.array([[1.0, 0, 0, 0], [-1, 0, 0, 2]])


@pytest.mark.parametrize(
    ("line", "expected"),
    [
        ([[0.5, 1, 2], [1.5, 1, 2]], [[0.5, 1, 2], [1.5, 1, 2]]),
        ([[-1, 0, 0], [1, 4, 0]], [[0, 2, 0], [1, 4, 0]]),
        ([[1, 4, 0], [-1, 0, 0]], [[1, 4, 0], [0, 2, 0]]),
        ([[-2, 0, 0], [4, 0, 6]], [[0, 0, 2], [2, 0, 4]]),
        ([[-2, 0, 0], [-1, 0, 0]], []),
        ([[3, 0, 0], [4, 0, 0]], []),
        ([[3, 0, 0], [3, 9, 0]], []),
        ([[1, 0, 0], [1, 9, 0]], [[1, 0, 0], [1, 9, 0]]),
    ],
)
def test_lines_are_cut_at_planes(line, expected):
    line = np.array(line, dtype=np.float32)
    both = np.concatenate([line, [[1, 1, 1], [1, 1, 0]]]).astype(np.float32)
    within = lines_within(both, BETWEEN)
    assert within.dtype == np.float32
    assert within[:-2] == pytest.approx(np.array(expected).reshape(-1, 3))
    assert (within[-2:] == both[-2:]).all()
    assert (lines_within(line, np.empty((0, 4))) == line).all()


@pytest.mark.parametrize(
    ("height", "reach", "seen"),
    [(9, 7.9, None), (9, 8.1, 1), (0, 0.9, None), (0, 1.1, -1)],
)
def test_points_are_looked_from_within_reach(height, reach, seen):
    bpy.ops.mesh.primitive_cube_add()
    pressed = Pressed(WCD_OT_show_sight)
    pressed.samples = 100
    cube = bpy.context.active_object
    pressed._commit(cube, run(pressed._begin(cube)))
    pressed._show((0.1, 0.1, height), (0, 0, -2), reach / 2)  # in double steps
    view = sight_overlay.current.view
    assert (view and view.point[2]) == pytest.approx(seen, abs=1e-4)
    bpy.ops.wcd.hide_sight()
