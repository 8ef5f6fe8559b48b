"""Split meshes and point clouds into weakly convex parts by lines of sight.

Scripts call `decompose`, `measure` and `build_hulls`. In Blender, `register` adds the
extension's panels and operators. Names are imported when they are first used, so that
enabling the extension is quick and scripts run without Blender.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:  # "as" makes a name public to type checkers
    from .core import ShapeCache as ShapeCache
    from .core import build_hulls_in_steps as build_hulls_in_steps
    from .core import decompose_in_steps as decompose_in_steps
    from .core import measure_in_steps as measure_in_steps
    from .core.errors import DecompositionError as DecompositionError
    from .core.geometry.mesh import TriangleMesh as TriangleMesh
    from .core.geometry.point_cloud import PointCloud as PointCloud
    from .core.parameters.hulls import HullParameters as HullParameters
    from .core.parameters.parts import Parameters as Parameters
    from .core.results.hulls import HullDecomposition as HullDecomposition
    from .core.results.parts import Decomposition as Decomposition
    from .core.results.parts import Measurement as Measurement
    from .core.steps.progress import run as run
    from .operators.bridge.rays.choice import choose_ray_caster as choose_ray_caster
    from .operators.bridge.read.arrays import stretch as stretch
    from .operators.scripting import build_hulls as build_hulls
    from .operators.scripting import decompose as decompose
    from .operators.scripting import measure as measure

# Module that each public name comes from. `core` has its own table of where.
_HOMES = {
    "Decomposition": "core.results.parts",
    "DecompositionError": "core.errors",
    "HullDecomposition": "core.results.hulls",
    "HullParameters": "core.parameters.hulls",
    "Measurement": "core.results.parts",
    "Parameters": "core.parameters.parts",
    "PointCloud": "core.geometry.point_cloud",
    "ShapeCache": "core",
    "TriangleMesh": "core.geometry.mesh",
    "build_hulls": "operators.scripting",
    "build_hulls_in_steps": "core",
    "choose_ray_caster": "operators.bridge.rays.choice",
    "decompose": "operators.scripting",
    "decompose_in_steps": "core",
    "measure": "operators.scripting",
    "measure_in_steps": "core",
    "run": "core.steps.progress",
    "stretch": "operators.bridge.read.arrays",
}
__all__ = ["register", "unregister", *_HOMES]


def __getattr__(name: str) -> Any:
    """Import a public name when it is first used."""
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value = getattr(import_module(f".{_HOMES[name]}", __name__), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    """Return the public names, including those that are not imported yet."""
    return sorted({*globals(), *__all__})


def register() -> None:
    """Register the operators, the settings and the command, then the panels.

    What is registered stays as it is.

    Raises
    ------
    DecompositionError
        If Python has no module bpy.
    """
    _check_blender()
    from . import operators, ui

    if not ui.is_registered():
        operators.register()
        ui.register()


def unregister() -> None:
    """Undo `register`, if it was called, in reverse order; raise as it does."""
    _check_blender()
    from . import operators, ui

    if ui.is_registered():
        ui.unregister()
        operators.unregister()


def _check_blender() -> None:
    """Raise a DecompositionError if Python has no module bpy."""
    try:
        import_module("bpy")
    except ModuleNotFoundError as error:
        from .core.errors import DecompositionError

        raise DecompositionError(
            "Blender is not installed; install its module with `pip install bpy`, or"
            " call `decompose`, `measure` and `build_hulls`, which do without"
            " `register`."
        ) from error
