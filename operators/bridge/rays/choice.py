"""Choose a ray caster: Blender's, or else Embree."""

from __future__ import annotations

from contextlib import suppress
from importlib import import_module
from typing import TYPE_CHECKING

from ....core.errors import DecompositionError

if TYPE_CHECKING:  # loads SciPy, which importing the package must not
    from ....core.sight.ray_march import MakeCaster


def choose_ray_caster() -> MakeCaster:
    """Return the first ray caster that is installed.

    Blender's `BVHTree` comes first, so that scripts find the same parts as Blender's
    window. Embree comes second, through the package embreex.

    Returns
    -------
    type
        Class whose instances cast rays: `RayCaster` of a `TriangleMesh`.

    Raises
    ------
    DecompositionError
        If neither is installed.
    """
    with suppress(ImportError):
        import_module("bpy")  # the bpy wheel provides mathutils once it is loaded
    with suppress(ImportError):  # mathutils without Blender has no BVHTree
        from .bvh import BvhRayCaster

        return BvhRayCaster
    with suppress(ImportError):
        from .embree import EmbreeRayCaster

        return EmbreeRayCaster
    raise DecompositionError(
        "No ray caster is installed; install Embree with `pip install embreex`, or"
        " Blender's module with `pip install bpy`."
    )
