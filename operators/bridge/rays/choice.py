"""Which ray caster there is: Blender's, or Embree."""

from __future__ import annotations

from contextlib import suppress
from importlib import import_module

from ....core.errors import DecompositionError
from ....core.sight.ray_march import MakeCaster


def choose_ray_caster() -> MakeCaster:
    """Return the class that casts rays on this Python.

    Blender's `BVHTree` comes first, so that scripts find the parts that the window
    finds. Embree is next, by the package embreex.

    Returns
    -------
    type
        Makes a `RayCaster` of a `TriangleMesh`.

    Raises
    ------
    DecompositionError
        If neither is installed.
    """
    with suppress(ImportError):
        import_module("bpy")  # the wheel brings mathutils along, once it is loaded
    with suppress(ImportError):  # the package mathutils alone has no BVHTree
        from .bvh import BvhRayCaster

        return BvhRayCaster
    with suppress(ImportError):
        from .embree import EmbreeRayCaster

        return EmbreeRayCaster
    raise DecompositionError(
        "No ray caster is installed; install Embree with `pip install embreex`, or"
        " Blender's module with `pip install bpy`."
    )
