"""The flat shapes of the figures: closed outlines in a plane."""

from __future__ import annotations

import bpy
import numpy as np
from shapes import FINGERS


def outline(*loops: np.ndarray) -> bpy.types.Object:
    """Return a filled curve with a border, (N, 2), and perhaps holes."""
    curve = bpy.data.curves.new("Outline", "CURVE")
    curve.dimensions, curve.fill_mode = "2D", "BOTH"
    for loop in loops:
        spline = curve.splines.new("POLY")
        spline.points.add(len(loop) - 1)
        places = np.column_stack([loop, np.zeros(len(loop)), np.ones(len(loop))])
        spline.points.foreach_set("co", places.ravel())
        spline.use_cyclic_u = True
    obj = bpy.data.objects.new("Outline", curve)
    bpy.context.collection.objects.link(obj)
    return obj


def hand() -> np.ndarray:
    """Return the outline of a hand."""
    points = [(0.45, -1.2), (-0.45, -1.2), (-0.9, -0.35)]
    for finger, (root, tip, radius) in enumerate(FINGERS):
        root, tip = np.array(root)[[0, 2]], np.array(tip)[[0, 2]]
        way = (tip - root) / np.linalg.norm(tip - root)
        side = np.array((-way[1], way[0])) * radius
        points.append(root + side)
        for angle in np.linspace(np.pi / 2, -np.pi / 2, 13):
            across = side * np.sin(angle)
            points.append(tip + across + way * radius * np.cos(angle))
        points.append(root - side)
        if finger == 0:
            points.append((-1.0, 0.85))  # the palm, between thumb and fingers
    return np.array([*points, (1.4, 0.6), (1.2, -0.4)])


def along(halves: list[tuple[float, float]]) -> np.ndarray:
    """Return the outline of a shape with half of its width at places along X."""
    upper = np.array(halves, dtype=float)
    return np.concatenate([upper, upper[::-1] * (1, -1)])


def spoon() -> np.ndarray:
    """Return a spoon: an oval bowl and a thin handle."""
    t = np.linspace(np.pi, 0.22, 40)
    bowl = np.column_stack([1.3 + 1.3 * np.cos(t), 0.9 * np.sin(t)])
    return along([*map(tuple, bowl), (6.6, 0.2), (6.8, 0.12)])


def fork() -> np.ndarray:
    """Return a fork: four tines, and the handle of the spoon."""
    points = []
    for lane in (0.72, 0.24, -0.24, -0.72):
        points += [(2.3, lane + 0.19), (0.0, lane + 0.15), (0.0, lane - 0.15)]
        points += [(2.3, lane - 0.19)]
    handle = [(2.9, -0.91), (3.4, -0.35), (3.7, -0.26), (6.6, -0.22), (6.8, -0.12)]
    mirrored = [(x, -y) for x, y in reversed(handle)]
    return np.array([*points, (2.4, -0.91), *handle, *mirrored, (2.4, 0.91)])


def notched(width: float, bottom: float) -> np.ndarray:
    """Return a square from -1 to 1 with a notch, `width` wide, down to `bottom`."""
    half = width / 2
    mouth = [(half, 1), (half * 0.8, bottom), (-half * 0.8, bottom), (-half, 1)]
    return np.array([(-1, 1), (-1, -1), (1, -1), (1, 1), *mouth])


def star(n_arms: int, inner: float) -> np.ndarray:
    """Return a star whose inner corners are `inner` from its center."""
    angles = np.pi / 2 + np.arange(2 * n_arms) * np.pi / n_arms
    radii = np.where(np.arange(2 * n_arms) % 2, inner, 1.0)
    return np.column_stack([radii * np.cos(angles), radii * np.sin(angles)])


def dumbbell(neck: float = 0.25) -> np.ndarray:
    """Return two discs with a bar between them."""
    t = np.linspace(np.pi, np.arcsin(neck), 40)
    left = np.column_stack([np.cos(t) - 1.6, np.sin(t)])
    right = (left * (-1, 1))[::-1]
    return along([*map(tuple, left), *map(tuple, right)])


def lobes(n_lobes: int, thin: float) -> np.ndarray:
    """Return lobes around a center, joined where they are `thin` from it."""
    angles = np.linspace(0, 2 * np.pi, 240, endpoint=False)
    radii = thin + (1 - thin) * np.abs(np.cos(n_lobes * angles / 2)) ** 0.8
    return np.column_stack([radii * np.cos(angles), radii * np.sin(angles)])


def horseshoe() -> np.ndarray:
    """Return three quarters of a ring."""
    angles = np.linspace(-0.25 * np.pi, 1.25 * np.pi, 60)
    ring = np.column_stack([np.cos(angles), np.sin(angles)])
    return np.concatenate([ring, ring[::-1] * 0.6])


def circle() -> np.ndarray:
    """Return a circle."""
    return along([(-np.cos(t), np.sin(t)) for t in np.linspace(0, np.pi, 60)])


def area(loop: np.ndarray) -> float:
    """Return the area within an outline."""
    x, y = loop.T
    return float(abs(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2)


def sees(loop: np.ndarray, one: np.ndarray, other: np.ndarray) -> bool:
    """Return whether the segment between two points of a shape stays inside."""
    start, way = loop, np.roll(loop, -1, axis=0) - loop
    ray = other - one

    def cross(a: np.ndarray, b: np.ndarray) -> np.ndarray:
        return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]

    turned = cross(ray, way)
    with np.errstate(divide="ignore", invalid="ignore"):
        t = cross(start - one, way) / turned
        u = cross(start - one, ray) / turned
    if ((t > 1e-6) & (t < 1 - 1e-6) & (u >= 0) & (u <= 1)).any():
        return False
    x, y = (one + other) / 2  # inside if a ray from it leaves an odd number of times
    above = (loop[:, 1] > y) != (np.roll(loop[:, 1], -1) > y)
    with np.errstate(divide="ignore", invalid="ignore"):
        edge_x = loop[:, 0] + (y - loop[:, 1]) / way[:, 1] * way[:, 0]
    return bool((above & (edge_x > x)).sum() % 2)
