"""Which ray caster there is: Blender's, or Embree."""

from __future__ import annotations

from contextlib import suppress
from importlib import import_module

from ....core.errors import DecompositionError
from ....core.geometry.array_checks import described
from ....core.sight.ray_caster import MakeCaster

_EMBREE = "install Embree with `pip install embreex`"
_BLENDER = "Blender's module with `pip install bpy`"
_MISSING = {
    None: f"No ray caster is installed; {_EMBREE}, or {_BLENDER}.",
    "EMBREE": f"Embree is not installed; {_EMBREE}, or leave `caster` out.",
    "BLENDER": f"Blender is not installed; install {_BLENDER}, or leave `caster` out.",
}
# Names of the ray casters, in the order in which they are tried.
CASTERS = ("BLENDER", "EMBREE")


def choose_ray_caster(caster: str | None = None) -> MakeCaster:
    """Return the class that casts rays on this Python.

    Blender's `BVHTree` comes first, so that scripts find the parts that the window
    finds. Embree is next, by the package embreex.

    Parameters
    ----------
    caster : 'BLENDER' or 'EMBREE', optional
        The one to take. By default the first one that is installed.

    Returns
    -------
    type
        Makes a `RayCaster` of a `TriangleMesh`.

    Raises
    ------
    TypeError
        If it is no name at all.
    DecompositionError
        If it is not installed, or if there is no caster of that name.
    """
    if not isinstance(caster, str | None):
        raise TypeError(
            f"`caster` must be one of {', '.join(CASTERS)}, not {described(caster)}."
        )
    if caster not in (None, *CASTERS):
        raise DecompositionError(
            f"There is no ray caster {caster!r}; choose one of {', '.join(CASTERS)}."
        )
    if caster != "EMBREE":
        with suppress(ImportError):
            import_module("bpy")  # the wheel brings mathutils along, once it is loaded
        with suppress(ImportError):  # the package mathutils alone has no BVHTree
            from .bvh import BvhRayCaster

            return BvhRayCaster
    if caster != "BLENDER":
        with suppress(ImportError):
            from .embree import EmbreeRayCaster

            return EmbreeRayCaster
    raise DecompositionError(_MISSING[caster])
