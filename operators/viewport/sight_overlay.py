"""The lines of sight that the viewports show; `ui` draws them.

They are not in Blender's data, because a file saved meanwhile would remember them.
"""

from __future__ import annotations

from dataclasses import dataclass

from ...core.results.views import View
from ...core.steps.arrays import Float32Array, FloatArray
from .viewports import redraw


@dataclass
class Overlay:
    """Lines of sight on an object.

    Attributes
    ----------
    object_uid : int
        The `session_uid` of the object.
    stretch : (3, 3) float
        Object space times this is the space of the view.
    workspace : str
        Name of the workspace whose status bar shows the hint.
    vertices : (V, 3) float
        The object's vertices or points when its samples were taken, in object space.
    view : View, optional
        What the point sees that was clicked last.
    """

    object_uid: int
    stretch: FloatArray
    workspace: str
    vertices: Float32Array
    view: View | None = None

    @property
    def share(self) -> float | None:
        """The share of the surface that the point sees, None before a click."""
        return None if self.view is None else float(self.view.visible.mean())


# The one overlay that is shown.
current: Overlay | None = None


def show(overlay: Overlay | None) -> None:
    """Show an overlay in place of another, None for no overlay."""
    global current
    current = overlay
    redraw()
