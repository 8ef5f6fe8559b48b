"""All texts stay in English: the extension has no translations."""

import ast

import bpy
import pytest
from checkout import ROOT
from weak_convex_decomposition import operators, ui
from weak_convex_decomposition.operators.bridge.parts.rows import WCD_PG_part
from weak_convex_decomposition.operators.bridge.registering import CONTEXT

CLASSES = (*operators._classes(), *ui.CLASSES, WCD_PG_part)
DRAWING = [*(ROOT / "ui").rglob("*.py"), *(ROOT / "operators").rglob("*.py")]


@pytest.mark.parametrize("cls", CLASSES, ids=lambda cls: cls.__name__)
def test_names_are_not_looked_up_in_blenders_catalog(cls):
    if hasattr(cls, "bl_label"):
        assert cls.bl_translation_context == CONTEXT
    rna = cls.bl_rna
    if issubclass(cls, bpy.types.Operator):
        name = cls.bl_idname.removeprefix("wcd.")
        rna = getattr(bpy.ops.wcd, name).get_rna_type()
        assert rna.translation_context == CONTEXT
    for name, definition in getattr(cls, "__annotations__", {}).items():
        own = name != "name" or not issubclass(cls, bpy.types.PropertyGroup)
        if own and hasattr(definition, "keywords"):
            assert rna.properties[name].translation_context == CONTEXT, name


def test_properties_of_objects_are_not():
    rna = bpy.types.Object.bl_rna.properties
    assert rna["wcd_active_part"].translation_context == CONTEXT


def literal(call, name):
    return next((each.value for each in call.keywords if each.arg == name), None)


def test_labels_are_drawn_as_they_are():
    """Blender has no context for these: they are looked up in its own one."""
    drawn = [
        (path.name, call)
        for path in DRAWING
        for call in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if getattr(getattr(call, "func", None), "attr", "") in {"label", "progress"}
        and literal(call, "text")
    ]
    assert len(drawn) > 20
    for name, call in drawn:
        empty = getattr(literal(call, "text"), "value", None) == ""
        verbatim = getattr(literal(call, "translate"), "value", True) is False
        assert empty or verbatim, f"{name}:{call.lineno}"
