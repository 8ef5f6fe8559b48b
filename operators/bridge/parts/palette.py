"""Colors of parts: a palette, and the color of the partner of a part.

The rule: all colors differ by 13 or more in CIELAB, and those of different pairs that
are not partners, base by base, by 25. None is gray (chroma 20 or more) or near black
(lightness 25 or more). A part and its mirror image have one hue, and lightness apart.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from ....core.steps.arrays import BoolArray, FloatArray
from ..stored.identity import Color, rgb

# sRGB of parts, each with that of its mirror image. The first seven are those of Okabe
# and Ito, "Color Universal Design", 2008, without black, which color-blind people tell
# apart. Each other one was found as the farthest from all before it.
_PALETTE = (
    (0x0072B2, 0x99C4F8),
    (0xE69F00, 0x755523),
    (0x009E73, 0xA8F1D1),
    (0xCC79A7, 0x733B5B),
    (0x56B4E9, 0x3F88B1),
    (0xD55E00, 0xFBB893),
    (0xF0E442, 0xA49B37),
    (0x6848D7, 0xB494FB),
    (0x50CF40, 0x0A7409),
    (0xFF2058, 0x9B1032),
    (0xF750D7, 0x91137D),
    (0xBFEF87, 0x7A915E),
    (0x20FFA7, 0x08C781),
    (0xF77870, 0xA45B55),
    (0x58489F, 0x8E7EB8),
    (0x00EFFF, 0x12A7B2),
    (0xFF108F, 0xB50F65),
    (0x87AF08, 0x435803),
    (0xAF0008, 0xFD5A41),
    (0xFFDF87, 0xBFA970),
    (0x0078EF, 0x89A6FD),
    (0xCF70FF, 0xE7BAFA),
    (0x8F4000, 0xDA834A),
    (0xFF6897, 0xFFB3C5),
)
# Their channels, (24, 2, 3), and the linear ones in numbers that Blender can hold.
_SRGB = (np.array(_PALETTE)[..., None] >> np.array((16, 8, 0)) & 0xFF) / 255
_LINEAR = np.where(
    _SRGB <= 0.04045, _SRGB / 12.92, ((_SRGB + 0.055) / 1.055) ** 2.4
).astype(np.float32)
# Linear RGBA of what has no part and no material.
UNPAINTED = (0.8, 0.8, 0.8, 1.0)
# Colors as near as this, in each channel, are the same one.
_SAME = 0.01
# Share of white that an artist's own color is mixed with for the mirror image; a light
# color is mixed with black instead.
_LIGHTER = 0.4
_LIGHT = 0.4


def free_color(used: Iterable[Sequence[float]]) -> Color:
    """Return the first color of the palette that is not in use, nor its partner's.

    If all are in use, the one that fewest parts have.
    """
    there = np.array([color[:3] for color in used]).reshape(-1, 1, 1, 3)
    counts = _are_same(there).sum(axis=(0, 2))
    return rgb(_LINEAR[np.argmin(counts), 0].tolist())


def usual_color(number: int) -> Color:
    """Return the color of a new part that has this number of new ones before it.

    It is what `free_color` gives one after the other.
    """
    return rgb(_LINEAR[number % len(_LINEAR), 0].tolist())


def partner_color(color: Sequence[float]) -> Color:
    """Return the color of the mirror image of a part with this linear color."""
    for pair, side in np.argwhere(_are_same(np.array(color[:3]))):
        return rgb(_LINEAR[pair, 1 - side].tolist())
    gray = 0.0 if np.mean(color[:3]) > _LIGHT else 1.0
    return rgb([c + (gray - c) * _LIGHTER for c in color])


def srgb_of(color: Sequence[float]) -> Color:
    """Return the sRGB color of a linear one."""
    return rgb(
        [12.92 * c if c <= 0.0031308 else 1.055 * c ** (1 / 2.4) - 0.055 for c in color]
    )


def _are_same(colors: FloatArray) -> BoolArray:
    """Return which colors of the palette are the same as each color."""
    return np.abs(colors - _LINEAR).max(axis=-1) < _SAME
