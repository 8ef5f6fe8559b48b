"""How hulls are seen: through, solid or as wires."""

from __future__ import annotations

from collections.abc import Sequence

import bpy

from ..parts.materials import discard_unused, is_ours

# The choices, with their labels and tooltips.
TRANSPARENT, SOLID, WIRE = "TRANSPARENT", "SOLID", "WIRE"
CHOICES = (
    (
        TRANSPARENT,
        "Transparent",
        "Solids that are seen through, in the colors of the parts",
    ),
    (SOLID, "Solid", "Solids in the colors of the parts"),
    (WIRE, "Wire", "Edges only"),
)
# Opacity of hulls that are seen through.
_OPACITY = 0.35


def look_like(hulls: Sequence[bpy.types.Object], look: str) -> None:
    """Show hulls in one of the looks of `CHOICES`.

    The material of the mesh may be that of a part, which is opaque. So a transparent
    hull wears a copy of its own. Materials that the user gave it stay as they are.
    """
    for hull in hulls:
        hull.display_type = "WIRE" if look == WIRE else "TEXTURED"
        opacity = _OPACITY if look == TRANSPARENT else 1.0
        hull.color = (*hull.color[:3], opacity)
        for slot in hull.material_slots:
            if slot.material is not None and not is_ours(slot.material):
                continue
            if slot.link == "OBJECT":
                worn, slot.material = slot.material, None
                discard_unused([worn] if worn else ())
            slot.link = "DATA"
            if look == TRANSPARENT and is_ours(slot.material):
                seen_through = _transparent(slot.material)
                slot.link = "OBJECT"
                slot.material = seen_through


def look_of(hull: bpy.types.Object) -> str:
    """Return how a hull is seen, as `look_like` takes it."""
    if hull.display_type == "WIRE":
        return WIRE
    return TRANSPARENT if hull.color[3] < 1.0 else SOLID


def _transparent(material: bpy.types.Material) -> bpy.types.Material:
    """Return a copy of a material that is seen through, in all kinds of shading."""
    copy = material.copy()
    copy.diffuse_color = (*material.diffuse_color[:3], _OPACITY)
    copy.surface_render_method = "BLENDED"
    for node in copy.node_tree.nodes if copy.node_tree else ():
        if node.type == "BSDF_PRINCIPLED":
            node.inputs["Alpha"].default_value = _OPACITY
    return copy
