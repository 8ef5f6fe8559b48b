"""Lines of sight drawn over the viewports; the mesh and the file know nothing of them.

Kept here and not in Blender's data: a file saved meanwhile would remember it.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import bpy
import gpu
import numpy as np
from gpu_extras.batch import batch_for_shader
from mathutils import Matrix
from numpy.typing import NDArray

from ..core.geometry.frames import frames

if TYPE_CHECKING:  # imports SciPy, which enabling the add-on must not
    from ..core.sight.point_view import View

_SEEN = (0.1, 0.85, 0.25, 1.0)
_HIDDEN = (0.1, 0.3, 1.0, 1.0)
_POINT = (1.0, 0.1, 0.1, 1.0)
_RAY = (0.3, 1.0, 0.45, 0.35)
_MOST_RAYS = 250
# Discs at samples: corners, radius in distances of samples, and how far above the
# surface they are, in radii.
_CORNERS = 8
_RADIUS = 0.2
_HEIGHT = 0.2


@dataclass
class Overlay:
    """What is drawn for an object.

    Attributes
    ----------
    object_uid : int
        Its `session_uid`.
    scale : (3,) float
        What coordinates of the object are multiplied by in those of the view.
    workspace : str
        Name of the workspace whose status bar says what can be done.
    vertices : (V, 3) float
        Where the object's vertices or points were when its samples were taken.
    view : View, optional
        What the point sees that was picked last.
    """

    object_uid: int
    scale: NDArray[np.float64]
    workspace: str
    vertices: NDArray[np.float32]
    view: View | None = None
    batches: list[tuple[Any, tuple[float, ...], str]] = field(default_factory=list)

    @property
    def share(self) -> float | None:
        """Share of the surface that the point sees, None before one is picked."""
        return None if self.view is None else float(self.view.visible.mean())


# The one overlay that is shown, and what takes it off the viewports.
current: Overlay | None = None
_handler: Any = None


def show(overlay: Overlay) -> None:
    """Draw an overlay from now on, in place of another."""
    global current, _handler
    hide()
    current = overlay
    _handler = bpy.types.SpaceView3D.draw_handler_add(_draw, (), "WINDOW", "POST_VIEW")
    redraw()


def hide() -> None:
    """Draw nothing any more."""
    global current, _handler
    if _handler is not None:
        bpy.types.SpaceView3D.draw_handler_remove(_handler, "WINDOW")
    current = _handler = None
    redraw()


def show_view(view: View) -> None:
    """Draw what a point sees, in place of another."""
    if current is not None:
        current.view = view
        current.batches = []
    redraw()


def redraw() -> None:
    """Let Blender draw the viewports, and their sidebars."""
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == "VIEW_3D":
                area.tag_redraw()


def _draw() -> None:
    """Draw over a viewport."""
    if current is None or current.view is None:
        return
    uid = current.object_uid
    obj = next((o for o in bpy.data.objects if o.session_uid == uid), None)
    space = bpy.context.space_data
    if (
        obj is None
        or not space.overlay.show_overlays
        or not obj.visible_in_viewport_get(space)
    ):
        return
    if not current.batches:
        current.batches = _batches(current.view)
    shader = gpu.shader.from_builtin("UNIFORM_COLOR")
    gpu.state.blend_set("ALPHA")
    with gpu.matrix.push_pop():
        gpu.matrix.multiply_matrix(obj.matrix_world)
        gpu.matrix.multiply_matrix(Matrix.Diagonal((*(1 / current.scale), 1.0)))
        for batch, color, depth_test in current.batches:
            gpu.state.depth_test_set(depth_test)
            shader.uniform_float("color", color)
            batch.draw(shader)
    gpu.state.depth_test_set("NONE")
    gpu.state.blend_set("NONE")


def _batches(view: View) -> list[tuple[Any, tuple[float, ...], str]]:
    """Return what is drawn, with its color and depth test."""
    shader = gpu.shader.from_builtin("UNIFORM_COLOR")
    radius = _radius(view)
    discs = _discs(view.places, view.normals, radius)
    ends = view.places[view.visible]
    ends = ends[:: len(ends) // _MOST_RAYS + 1]
    rays = np.stack([np.broadcast_to(view.point, ends.shape), ends], axis=1)
    ball = _discs(np.tile(view.point, (3, 1)), np.eye(3), 1.5 * radius, lifted=False)
    kinds = (
        ("TRIS", discs[~view.visible], _HIDDEN, "LESS_EQUAL"),
        ("TRIS", discs[view.visible], _SEEN, "LESS_EQUAL"),
        ("LINES", rays, _RAY, "NONE"),
        ("TRIS", ball, _POINT, "NONE"),
    )
    return [
        (
            batch_for_shader(
                shader, kind, {"pos": corners.reshape(-1, 3).astype(np.float32)}
            ),
            color,
            depth_test,
        )
        for kind, corners, color, depth_test in kinds
        if len(corners)
    ]


def _radius(view: View) -> float:
    """Return the radius of discs, by the distance of samples."""
    extent = np.linalg.norm(np.ptp(view.places, axis=0))
    return float(_RADIUS * extent / np.sqrt(len(view.places)))


def _discs(
    places: NDArray[np.float64],
    normals: NDArray[np.float64],
    radius: float,
    lifted: bool = True,
) -> NDArray[np.float64]:
    """Return the triangles of discs that lie on a surface, (N, corners, 3, 3)."""
    first, second = frames(normals)
    turns = 2 * np.pi * np.arange(_CORNERS + 1) / _CORNERS
    around = radius * (
        first[:, None] * np.cos(turns)[:, None]
        + second[:, None] * np.sin(turns)[:, None]
    )
    middles = places + (_HEIGHT * radius * normals if lifted else 0.0)
    rims = middles[:, None] + around
    hubs = np.broadcast_to(middles[:, None], rims[:, 1:].shape)
    return np.stack([hubs, rims[:, :-1], rims[:, 1:]], axis=2)
