"""A stand-in for the window that Blender as a Python module lacks."""

import inspect
from types import SimpleNamespace

import bpy
from mathutils import Vector
from weak_convex_decomposition.operators.decompose import WCD_OT_decompose
from weak_convex_decomposition.operators.hulls import WCD_OT_build_hulls
from weak_convex_decomposition.operators.measure import WCD_OT_measure
from weak_convex_decomposition.operators.running import modal
from weak_convex_decomposition.operators.viewport.part_at import part_along
from weak_convex_decomposition.operators.viewport.viewports import shown_along

FRONT = Vector((0.0, 1.0, 0.0))
OPERATORS = (WCD_OT_decompose, WCD_OT_measure, WCD_OT_build_hulls)

# What operators are given in place of their defaults.
FAST = {"samples": 300, "max_parts": 6, "max_hulls": 4}
TIMER = SimpleNamespace(type="TIMER", value="NOTHING")
MOUSE = SimpleNamespace(type="MOUSEMOVE", value="NOTHING")
ESC = SimpleNamespace(type="ESC", value="PRESS")


# What is said of an object that cannot be written to.
GONE = "The mesh was changed or deleted meanwhile; start again."


def cube_at(x):
    # Each of another shape: lines of sight of the latest are kept.
    bpy.ops.mesh.primitive_cube_add(location=(x, 0, 0), scale=(1, 1, 1 + x))
    return bpy.context.active_object


def space_of_window():
    """Return the space of the viewport of the window."""
    areas = bpy.context.window_manager.windows[0].screen.areas
    return next(a for a in areas if a.type == "VIEW_3D").spaces.active


def seen(x, z=0.0):
    """Return the object and part that are seen at x from the front."""
    bpy.context.view_layer.update()
    space, ray = space_of_window(), (Vector((x, -9.0, z)), FRONT)
    within = shown_along(space, space.region_3d, *ray)
    return part_along(bpy.context, space, *ray, within)


def select(*objects):
    for obj in objects:
        obj.select_set(True)


class Window:
    """Keeps what computations add to a window and its manager."""

    def __init__(self):
        self.timers, self.handlers, self.status = [], [], None
        self.windows = []

    def event_timer_add(self, pause, window):
        assert window is self
        self.timers.append(pause)
        return pause

    def event_timer_remove(self, timer):
        self.timers.remove(timer)

    def modal_handler_add(self, operator):
        self.handlers.append(operator)

    def status_text_set(self, text):
        self.status = text

    def is_clean(self):
        return not self.timers and self.status is None and modal.current is None


def call_of(cls):
    return getattr(bpy.ops.wcd, cls.bl_idname.removeprefix("wcd."))


def values_of(cls):
    """Return the values of all properties of an operator."""
    rna = call_of(cls).get_rna_type().properties
    values = {name: rna[name].default for name in set(rna.keys()) - {"rna_type"}}
    return values | {name: FAST[name] for name in FAST.keys() & values.keys()}


class Pressed:
    """Stands for an instance of a registered operator, which Blender alone can make.

    All that is not a property is the operator's own, bound to this: its methods and
    those of the classes above it.
    """

    def __init__(self, cls):
        values = values_of(cls)
        vars(self).update(values, _cls=cls, reports=[])
        self.properties = SimpleNamespace(is_property_set=values.__contains__)

    @property
    def __class__(self):  # for `super()` in the operator's methods
        return self._cls

    def __getattr__(self, name):
        found = inspect.getattr_static(self._cls, name)
        return found.__get__(self, self._cls) if hasattr(found, "__get__") else found

    def report(self, kind, text):
        self.reports.append((*kind, text))


def press(cls, window, **values):
    """Return an operator that runs modally on the active object, with some values."""
    context = SimpleNamespace(
        active_object=bpy.context.active_object,
        selected_objects=bpy.context.selected_objects,
        objects_in_mode=bpy.context.objects_in_mode,
        scene=bpy.context.scene,
        window=window,
        window_manager=window,
        workspace=SimpleNamespace(name="Layout"),
    )
    pressed = Pressed(cls)
    vars(pressed).update(values)
    assert cls.poll(context)
    answer = pressed.invoke(context, MOUSE)
    assert answer == {"RUNNING_MODAL"}, answer
    return pressed


def finish(pressed):
    """Send events of the timer until the operator ends; return how it does."""
    while (answer := pressed.modal(None, TIMER)) == {"PASS_THROUGH"}:
        pass
    return answer


def errors_of(pressed):
    """Return the errors; those of a window come late, as warnings without a popup."""
    return [text for kind, text in pressed.reports if kind in {"ERROR", "WARNING"}]
