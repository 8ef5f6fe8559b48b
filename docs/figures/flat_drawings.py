"""The figures of flat shapes, one function each, by the name of their file."""

from __future__ import annotations

import bpy
import extension
import numpy as np
import outlines
import shapes
from image import below, beside
from panels import GREEN, RED, paint, parts
from render import FROM_ABOVE, caption, panel
from scipy.spatial import ConvexHull

_GRAY = (0.42, 0.5, 0.58)
_PALE = (0.75, 0.78, 0.82)


def hands() -> np.ndarray:
    """Draw a hand as an outline and as a solid (fig. 3)."""
    flat = outlines.outline(outlines.hand())
    return beside(
        [
            parts(flat, "an outline: {k} parts", 420),
            parts(shapes.hand(), "a solid: {k} parts", 420, turn=10),
        ]
    )


def ranks() -> np.ndarray:
    """Draw shapes over their convexity ranks (fig. 4)."""
    loops = (
        outlines.circle(),
        outlines.lobes(2, 0.6),
        outlines.star(5, 0.6),
        outlines.dumbbell(),
        outlines.lobes(3, 0.25),
        outlines.horseshoe(),
        outlines.star(5, 0.35),
        outlines.star(12, 0.3),
    )
    measured = [(extension.rank(outlines.outline(loop)), loop) for loop in loops]
    measured.sort(key=lambda pair: -pair[0])
    panels = [_flat(loop, f"{rank:.2f}") for rank, loop in measured]
    return below([beside(panels[:4]), beside(panels[4:])])


def before_after() -> np.ndarray:
    """Draw shapes with their ranks before and after (fig. 5)."""
    rows = []
    for loop in (outlines.lobes(3, 0.25), outlines.star(3, 0.12)):
        rank = extension.rank(outlines.outline(loop))
        rows.append(_flat(loop, f"rank {rank:.2f}"))
        obj = outlines.outline(loop)
        rows.append(parts(obj, "{k} parts, mean rank {mean:.2f}", 230))
    return beside(rows)


def walk() -> np.ndarray:
    """Draw lines of sight within a part and between parts (fig. 6)."""
    loop = outlines.dumbbell(0.17)
    rng = np.random.default_rng(3)
    ends = np.roll(loop, -1, axis=0)
    lengths = np.linalg.norm(ends - loop, axis=1)
    steps = (np.arange(30) + rng.random(30)) / 30 * lengths.sum()
    edges = np.searchsorted(lengths.cumsum(), steps)
    left = ((lengths.cumsum()[edges] - steps) / lengths[edges])[:, None]
    spots = (loop[edges] * left + ends[edges] * (1 - left)) * 0.995
    obj = outlines.outline(loop)
    paint(obj, _PALE)
    drawn = [obj]
    for i, one in enumerate(spots):
        for other in spots[:i]:
            if not outlines.sees(loop, one, other):
                continue
            crosses = one[0] * other[0] < 0
            drawn.append(_line(one, other, 0.05 + 0.05 * crosses, crosses))
    return panel(drawn, size=640, turn=0, elevation=FROM_ABOVE)[185:455]


def measures() -> np.ndarray:
    """Draw a spoon and a fork over two measures of convexity (fig. 12)."""
    return below([_compared(outlines.spoon()), _compared(outlines.fork())])


def notches() -> np.ndarray:
    """Draw notches of one depth and different widths (fig. 13)."""
    panels = []
    for width, bottom in ((1.9, -0.3), (0.3, -0.3), (0.06, 0.6)):
        loop = outlines.notched(width, bottom)
        rank = extension.rank(outlines.outline(loop))
        panels.append(_flat(loop, f"{rank:.2f}"))
    return beside(panels)


def _flat(loop: np.ndarray, text: str) -> np.ndarray:
    """Return a panel of an outline as it is."""
    obj = outlines.outline(loop)
    paint(obj, _GRAY)
    return panel([obj], text, size=230, turn=0, elevation=FROM_ABOVE)


def _line(one, other, height: float, crosses: bool) -> bpy.types.Object:
    """Return a thin bar between two points, above the outline."""
    way = other - one
    side = np.array((-way[1], way[0])) / np.linalg.norm(way) * 0.008
    corners = [one + side, one - side, other - side, other + side]
    mesh = bpy.data.meshes.new("Line")
    mesh.from_pydata([(*corner, height) for corner in corners], [], [(0, 1, 2, 3)])
    obj = bpy.data.objects.new("Line", mesh)
    paint(obj, RED if crosses else GREEN)
    return obj


def _compared(loop: np.ndarray) -> np.ndarray:
    share = outlines.area(loop) / ConvexHull(loop).volume
    rank = extension.rank(outlines.outline(loop))
    obj = outlines.outline(loop)
    paint(obj, _GRAY)
    view = panel([obj], size=620, turn=0, elevation=FROM_ABOVE)[215:405]
    text = f"area / area of the hull {share:.2f}, convexity rank {rank:.2f}"
    return np.concatenate([view, caption(text, 620)])


FIGURES = {
    each.__name__: each
    for each in (hands, ranks, before_after, walk, measures, notches)
}
