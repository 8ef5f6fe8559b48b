"""Colors of parts that color-blind people can tell apart, too."""

from __future__ import annotations

# Okabe and Ito, "Color Universal Design", 2008, with a middle gray in place of black.
# The order puts contrasting colors next to each other.
_HUES = (
    0x0072B2,
    0xE69F00,
    0x009E73,
    0xCC79A7,
    0x56B4E9,
    0xD55E00,
    0xF0E442,
    0x999999,
)
# Each further round mixes the hues with black or white: (gray level, share of it).
_ROUNDS = ((0.0, 0.0), (0.0, 0.5), (1.0, 0.6), (0.0, 0.75))


def part_color(index: int) -> tuple[float, float, float, float]:
    """Return the linear RGBA color of a part, each in 0…1; repeats after 32 parts."""
    red, green, blue = map(_linear, part_srgb(index))
    return red, green, blue, 1.0


def part_srgb(index: int) -> tuple[float, float, float]:
    """Return the sRGB color of a part, each in 0…1, for pictures."""
    hue = _HUES[index % len(_HUES)]
    gray, share = _ROUNDS[index // len(_HUES) % len(_ROUNDS)]
    pure = ((hue >> shift & 0xFF) / 255 for shift in (16, 8, 0))
    red, green, blue = (c + (gray - c) * share for c in pure)
    return red, green, blue


def _linear(srgb: float) -> float:
    """Return the linear value of an sRGB channel."""
    if srgb <= 0.04045:
        return srgb / 12.92
    return float(((srgb + 0.055) / 1.055) ** 2.4)
