"""Register classes and properties: their texts stay in English, and nothing moves them.

The extension has no translations. But some of its words are in Blender's catalog, so
that labels would be in two languages, and "Smooth" would become the word for soft
materials. Names are looked up in a translation context; ours has no entries. Labels and
bars of progress have none: they are drawn with `translate=False`.

Keyframes and drivers would set what they move on Blender's copy of an object, where a
color that changes the materials of the file damages them.
"""

from __future__ import annotations

from typing import Any

import bpy

CONTEXT = "Convex Parts"


def register_class(cls: Any) -> None:
    """Register a class with Blender, and its properties as our `own`."""
    cls.bl_translation_context = CONTEXT
    for each in getattr(cls, "__annotations__", {}).values():
        if hasattr(each, "keywords"):
            own(each)
    bpy.utils.register_class(cls)


def own(definition: Any) -> Any:
    """Return the definition of a property; it is neither translated nor animated."""
    definition.keywords["translation_context"] = CONTEXT
    definition.keywords.setdefault("options", set())  # Blender's is to be animated
    return definition
