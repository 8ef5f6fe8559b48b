"""Panels of the figures: shapes in one color, or in the colors of their parts."""

from __future__ import annotations

from typing import Any

import bpy
import extension
import numpy as np
from render import FROM_ABOVE, panel

GREEN = (0.03, 0.42, 0.12)
BLUE = (0.04, 0.16, 0.5)
RED = (0.8, 0.02, 0.02)


def paint(obj: bpy.types.Object, *colors: tuple[float, float, float]) -> None:
    """Give an object materials of linear colors, in place of those it has."""
    obj.data.materials.clear()
    for color in colors:
        material = bpy.data.materials.new("Figure")
        material.diffuse_color = (*color, 1.0)
        obj.data.materials.append(material)


def parts(
    obj: bpy.types.Object,
    text: str,
    size: int = 400,
    turn: float = 35.0,
    **parameters: Any,
) -> np.ndarray:
    """Return a panel of an object in parts; the text may name figures of its record."""
    record = extension.decompose(obj, **parameters)
    shown = bpy.context.object
    mean = np.mean([part["convexity_rank"] for part in record["parts"]])
    flat = shown.dimensions.z == 0
    text = text.format(mean=mean, **record)
    if flat:
        return panel([shown], text, size, 0, FROM_ABOVE)
    return panel([shown], text, size, turn)
