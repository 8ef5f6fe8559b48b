"""Flat meshes for tests: what outlines enclose, in small triangles."""

import numpy as np
from scipy.spatial import Delaunay, cKDTree
from weak_convex_decomposition.core.geometry.mesh import TriangleMesh

L = np.array([(0, 0), (4, 0), (4, 1), (1, 1), (1, 4), (0, 4)], dtype=float)


def comb(n_teeth):
    """Return the outline of a bar with teeth of width 1, 1 apart."""
    teeth = [[(x + 1, 1), (x + 1, 4), (x, 4), (x, 1)] for x in range(0, 2 * n_teeth, 2)]
    bar = [(0, 0), (2 * n_teeth - 1, 0)]
    return np.array([*bar, *np.concatenate(teeth[::-1])], dtype=float)


def circle(radius, n_corners=24):
    """Return a regular polygon."""
    angles = np.linspace(0, 2 * np.pi, n_corners, endpoint=False)
    return radius * np.stack([np.cos(angles), np.sin(angles)], axis=1)


def finger(root, angle, length, width):
    """Return a side, a round tip and the other side of a finger."""
    along = np.array([np.cos(np.radians(angle)), np.sin(np.radians(angle))])
    across = np.array([along[1], -along[0]])
    turns = np.linspace(0, np.pi, 8)[:, None]
    round_tip = np.cos(turns) * across + np.sin(turns) * along
    tip = root + (length - width / 2) * along + width / 2 * round_tip
    return [root + width / 2 * across, *tip, root - width / 2 * across]


FINGERS = [
    finger((0.95, -0.2), 35, 1.15, 0.42),
    finger((0.66, 0.9), 80, 1.3, 0.36),
    finger((0.22, 1.0), 89, 1.5, 0.38),
    finger((-0.22, 1.0), 97, 1.4, 0.36),
    finger((-0.64, 0.88), 107, 1.1, 0.32),
]
PALM = [(-0.95, 0.4), (-0.9, -0.4), (-0.6, -1.0), (0.6, -1.0), (0.9, -0.6)]
HAND = np.array([*PALM, *FINGERS[0], (0.88, 0.45), *np.concatenate(FINGERS[1:])])


def filled(*outlines, spacing):
    """Return triangles of about one size between outlines, in the plane z = 0."""
    rims = [_divided(outline, spacing) for outline in outlines]
    rim = np.concatenate(rims)
    low, high = rim.min(axis=0), rim.max(axis=0)
    counts = np.ceil((high - low) / spacing).astype(int)
    grid = low + spacing * np.indices(counts).reshape(2, -1).T
    far = cKDTree(rim).query(grid)[0] > 0.6 * spacing
    corners = np.concatenate([rim, grid[far & inside(grid, outlines)]])
    triangles = Delaunay(corners).simplices
    (ax, ay), (bx, by), (cx, cy) = np.moveaxis(corners[triangles], 0, -1)
    doubled = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
    triangles[doubled < 0] = triangles[doubled < 0, ::-1]
    triangles = triangles[
        inside(corners[triangles].mean(axis=1), outlines) & (abs(doubled) > 1e-9)
    ]
    vertices = np.pad(corners, ((0, 0), (0, 1)))
    return TriangleMesh(vertices, triangles, np.arange(len(triangles)))


def inside(points, outlines):
    """Return which points lie within an odd number of outlines."""
    x, y = points.T[:, :, None]
    crossed = np.zeros(len(points), dtype=int)
    for outline in outlines:
        (ax, ay), (bx, by) = outline.T, np.roll(outline, -1, axis=0).T
        with np.errstate(divide="ignore", invalid="ignore"):
            right = x < ax + (y - ay) / (by - ay) * (bx - ax)
        crossed += (((ay > y) != (by > y)) & right).sum(axis=1)
    return crossed % 2 == 1


def _divided(outline, spacing):
    """Return the points of an outline with others between them."""
    pieces = []
    for here, there in zip(outline, np.roll(outline, -1, axis=0), strict=True):
        number = max(round(np.linalg.norm(there - here) / spacing), 1)
        pieces.append(here + (there - here) * np.arange(number)[:, None] / number)
    return np.concatenate(pieces)
