"""How the colors of parts are shown: by materials, or as an overlay of the viewports.

An overlay leaves slots and materials as the user had them; `ui` draws it.
"""

from __future__ import annotations

from dataclasses import replace

import bpy
import numpy as np

from ..mesh.layers import layers_of
from ..parts.materials import own_materials, recolor
from ..parts.part_materials import (
    drop_kept,
    is_overlaid,
    keep,
    kept_materials,
    part_materials,
)
from ..parts.slots import put_in_slots, take_out_of_slots
from ..stored.names import GROUP_LAYER, MATERIAL_LAYER, OWNER_LAYER, PART_LAYER
from ..stored.noted_parts import identities_of
from ..stored.record import change_part, record_of
from ..stored.restore import read_restore, sharers, write_restore

# The choices, with their labels and tooltips.
MATERIALS, OVERLAY = "MATERIALS", "OVERLAY"
CHOICES = (
    (
        MATERIALS,
        "Materials",
        "A material slot for each part, for renders and exports too",
    ),
    (
        OVERLAY,
        "Overlay",
        "Colors over the faces in every shading of the viewports. Slots and materials"
        " stay as they are",
    ),
)


def show_colors_as(obj: bpy.types.Object, choice: str) -> None:
    """Show the colors of an object's parts in one of the ways of `CHOICES`."""
    if choice == OVERLAY:
        show_as_overlay(obj)
    else:
        show_as_materials(obj)


def show_as_overlay(obj: bpy.types.Object) -> None:
    """Take the materials of parts out of the slots, and keep them on the mesh."""
    restore = read_restore(obj.data)
    if restore is None or is_overlaid(obj) or obj.type != "MESH":
        return
    materials = {n: first for n, (first, *_) in part_materials(obj).items()}
    take_out_of_slots(obj, restore)
    layers_of(obj).remove(MATERIAL_LAYER)
    keep(obj, materials)


def show_as_materials(obj: bpy.types.Object) -> None:
    """Put the materials of parts into slots after those that the user has now."""
    restore, layers = read_restore(obj.data), layers_of(obj)
    identities = sorted(identities_of(record_of(obj)), key=lambda each: each.number)
    numbers = layers.faces(PART_LAYER)
    if restore is None or numbers is None or not (identities and is_overlaid(obj)):
        return
    kept = kept_materials(obj.data)
    drop_kept(obj.data)
    materials = own_materials(identities, kept)
    for identity, material in zip(identities, materials, strict=True):
        recolor(material, identity.color)
        for sharer in sharers(obj):
            change_part(sharer, identity.number, {"material": material.name})
    for name in (OWNER_LAYER, GROUP_LAYER):
        layers.remove(name)
    rows = np.searchsorted([each.number for each in identities], numbers)
    fields = put_in_slots(obj, materials, np.minimum(rows, len(identities) - 1))
    write_restore(obj.data, replace(restore, **fields))
    layers.finish()
