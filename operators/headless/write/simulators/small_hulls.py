"""Hulls so small that MuJoCo refuses their meshes, or takes them as shells alone."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .....core.geometry.mesh import TriangleMesh
from .....core.solids.volume import signed_volume
from .....core.steps.arrays import FloatArray
from .....core.steps.progress import run
from ...current_file import some_of
from .bodies import Body, Geometry

# MuJoCo refuses solids of less volume in cubic meters, and surfaces of less area in
# square meters. It rounds coordinates to single precision first, which flattens what is
# far smaller than it is far away from the origin of its body.
_LEAST = 1e-15
_ROUNDED = 1.01
_FLAT = 1e-9
_FOR_XML = "; make the model larger, or choose Bodies = Each."


def is_shell(shape: Geometry) -> bool:
    """Return whether MuJoCo takes a mesh as a shell alone.

    Collisions are the same, and the mass of the body is not that of its meshes.
    """
    return _volume_and_area(_in_mujoco(shape), shape)[0] < _ROUNDED * _LEAST


def small_hull_notes(bodies: Sequence[Body], urdf: bool) -> tuple[str, ...]:
    """Return a sentence to the user if MuJoCo refuses hulls: URDF knows no shells."""
    small = [
        shape.name
        for body in bodies
        for shape in body.collisions
        if shape.primitive is None and _is_refused(shape, urdf)
    ]
    if not small:
        return ()
    advice = "; write .xml, or make the model larger." if urdf else _FOR_XML
    return (f"MuJoCo refuses hulls as small as these: {some_of(small)}{advice}",)


def _is_refused(shape: Geometry, urdf: bool) -> bool:
    """Return whether MuJoCo refuses a mesh, in URDF or in its own format."""
    vertices = _in_mujoco(shape)
    size = np.abs(vertices).max()
    around = vertices - vertices.mean(axis=0)
    if np.linalg.svd(around, compute_uv=False)[-1] < _FLAT * size:
        return True
    volume, area = _volume_and_area(vertices, shape)
    return (volume if urdf else area) < _ROUNDED * _LEAST


def _in_mujoco(shape: Geometry) -> FloatArray:
    """Return the vertices of a mesh as MuJoCo has them."""
    return shape.vertices.astype(np.float32).astype(np.float64)


def _volume_and_area(vertices: FloatArray, shape: Geometry) -> tuple[float, float]:
    """Return the volume and the area of a mesh with other vertices."""
    rows = np.arange(len(shape.triangles))
    mesh = TriangleMesh(vertices - vertices.mean(axis=0), shape.triangles, rows)
    return abs(run(signed_volume(mesh))), float(mesh.areas.sum())
