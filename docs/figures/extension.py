"""The extension as the figures use it: the only file that knows its insides."""

from __future__ import annotations

import importlib
import importlib.util
import json
import sys
from pathlib import Path
from typing import Any

import bpy
import numpy as np

ROOT = Path(__file__).resolve().parents[2]
_PACKAGE = "weak_convex_decomposition"


def switch_on() -> None:
    """Load this checkout, whatever its folder is called, and register its operators."""
    spec = importlib.util.spec_from_file_location(
        _PACKAGE, ROOT / "__init__.py", submodule_search_locations=[str(ROOT)]
    )
    package = importlib.util.module_from_spec(spec)
    sys.modules[_PACKAGE] = package
    spec.loader.exec_module(package)
    package.register()


def _load(module: str) -> Any:
    return importlib.import_module(f"{_PACKAGE}.{module}")


def activate(obj: bpy.types.Object) -> None:
    """Make an object the only selected one."""
    bpy.ops.object.select_all(action="DESELECT")
    obj.select_set(True)
    bpy.context.view_layer.objects.active = obj


def decompose(obj: bpy.types.Object, **parameters: Any) -> dict[str, Any]:
    """Split an object as the button does, and return the record of what has the parts.

    That is the active object then: a new one if `obj` is a curve.
    """
    activate(obj)
    bpy.ops.wcd.decompose(**parameters)
    return json.loads(bpy.context.object["wcd"])


def rank(obj: bpy.types.Object) -> float:
    """Return the convexity rank of a whole object, as Measure does.

    A curve becomes a mesh.
    """
    activate(obj)
    if obj.type == "CURVE":
        bpy.ops.object.convert(target="MESH")
    bpy.ops.wcd.measure()
    return json.loads(obj["wcd"])["measured"]["convexity_rank"]


def mirror(obj: bpy.types.Object) -> None:
    """Copy the parts on the side of positive X to the other side."""
    activate(obj)
    bpy.ops.wcd.mirror_parts()


def rows(obj: bpy.types.Object) -> list[Any]:
    """Return the rows of the table of parts, with name and color, by number."""
    return sorted(obj.wcd_parts, key=lambda row: row.number)


def explode(obj: bpy.types.Object, distance: float) -> None:
    """Move the parts of an object away from its center."""
    activate(obj)
    bpy.ops.wcd.explode(distance=distance)


def implode(obj: bpy.types.Object) -> None:
    """Take the exploded view back."""
    activate(obj)
    bpy.ops.wcd.implode()


def hulls(obj: bpy.types.Object) -> list[bpy.types.Object]:
    """Put a collision hull around each part of an object, and return the hulls."""
    activate(obj)
    bpy.ops.wcd.build_hulls(pieces="PARTS")
    return list(_load("operators.bridge.hulls.hull_objects").hulls_of(obj))


def picture(obj: bpy.types.Object, kind: str) -> np.ndarray:
    """Return a picture of the Image Editor, (H, W, 3), the upper row first."""
    activate(obj)
    before = set(bpy.data.images)
    bpy.ops.wcd.show_picture(picture=kind)
    image = next(each for each in bpy.data.images if each not in before)
    width, height = image.size
    pixels = np.array(image.pixels, dtype=np.float32).reshape(height, width, 4)
    return pixels[::-1, :, :3]


def parts_of_faces(obj: bpy.types.Object) -> np.ndarray:
    """Return the part of each face, (F,) int."""
    return np.array([each.value for each in obj.data.attributes["wcd_part"].data])


def splats(obj: bpy.types.Object) -> bpy.types.Mesh:
    """Return the splats of a decomposed cloud as a mesh in the colors of its parts."""
    return _load("operators.headless.write.picture_scene").splat_mesh(obj)


def seen_from(
    obj: bpy.types.Object, origin: np.ndarray, direction: np.ndarray, samples: int
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Return what the first point along a ray sees.

    Returns
    -------
    point : (3,) float
    places, normals : (N, 3) float
        Samples of the surface.
    visible : (N,) bool
        Whether the point sees them.
    """
    parameters = _load("core.parameters.parts").Parameters(samples=samples)
    steps = _load("operators.bridge.work.computing").point_viewer_of(obj, parameters)
    viewer = _load("core.steps.progress").run(steps)
    view = viewer.look(np.asarray(origin, float), np.asarray(direction, float))
    return view.point, view.places, view.normals, view.visible
