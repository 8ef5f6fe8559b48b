"""Keep the texts of the extension in English, whatever the language of the interface.

It has no translations. But some of its words are in Blender's catalog, so that labels
would be in two languages, and "Smooth" would become the word for soft materials. Names
are looked up in a translation context; ours has no entries. Labels and bars of progress
have none: they are drawn with `translate=False`.
"""

from __future__ import annotations

from typing import Any

import bpy

CONTEXT = "Convex Parts"


def register_class(cls: Any) -> None:
    """Register a class with Blender; its names and those of its properties stay."""
    cls.bl_translation_context = CONTEXT
    for each in getattr(cls, "__annotations__", {}).values():
        if hasattr(each, "keywords"):
            in_english(each)
    bpy.utils.register_class(cls)


def in_english(definition: Any) -> Any:
    """Return the definition of a property; its name and those of its choices stay."""
    definition.keywords["translation_context"] = CONTEXT
    return definition
