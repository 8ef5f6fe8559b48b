"""Edit Mode is entered while parts are computed; each step is undone by itself.

Undo and redo of edits bring the table back with the faces.
"""

import bmesh
import bpy
from edited import check_in_step
from leftovers import leftovers
from snapshot import snapshot
from weak_convex_decomposition.operators.bridge.parts.figures import figures_of
from weak_convex_decomposition.operators.running import modal as running


def mode():
    return bpy.context.active_object.mode


def state():
    """Return what there is of the active object in Edit Mode, which is not left."""
    obj = bpy.context.active_object
    bm = bmesh.from_edit_mesh(obj.data)
    weights = bm.verts.layers.deform.active
    return {
        "groups": obj.vertex_groups.keys(),
        "slots": obj.data.materials.keys(),
        "notes": (obj.get("wcd"), obj.data.get("wcd_restore")),
        "rows": [(row.name, tuple(row.color)) for row in obj.wcd_parts],
        "faces": [
            (face.material_index, *(face[i] for i in bm.faces.layers.int.values()))
            for face in bm.faces
        ],
        "weights": [vertex[weights].items() for vertex in bm.verts if weights],
    }


def steps(hands):
    yield from hands.open_sidebar()
    before = snapshot(hands.suzanne(1))
    yield from hands.take_samples(800)
    place = yield from hands.find("wcd.decompose")
    yield from hands.click(place)
    yield lambda: running.current is not None
    area = hands.area
    yield from hands.move(area.x + area.width // 4, area.y + area.height // 2)
    yield from hands.press("Tab")
    yield lambda: mode() == "EDIT"
    assert running.current is not None
    yield lambda: running.current is None
    yield lambda: "wcd" in bpy.context.active_object
    assert leftovers() == []
    yield 0.5
    hands.picture("done")
    yield from hands.undo()
    yield lambda: "wcd" not in bpy.context.active_object
    assert mode() == "EDIT"
    yield from hands.undo()
    yield lambda: mode() == "OBJECT"
    assert snapshot(bpy.context.active_object) == before
    yield from clear_and_undo(hands)
    yield from assign_smooth_and_undo(hands)


def table():
    """Return what the table says of the active object's parts."""
    figures = figures_of(bpy.context.active_object)
    faces = figures.measured_on[:, 0].tolist()
    names = [each.name for each in figures.identities]
    return names, faces, figures.ranks.tolist(), figures.problem, figures.record["psi"]


def assign_smooth_and_undo(hands):
    """Give faces to another part and smooth all seams; undo and redo each by keys."""
    yield from hands.parted_suzanne(1, samples=300)
    area, obj = hands.area, bpy.context.active_object
    yield from hands.move(area.x + area.width // 4, area.y + area.height // 2)
    obj.wcd_active_part = 2
    bpy.context.tool_settings.mesh_select_mode = (False, False, True)
    with hands.context():
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.mesh.select_all(action="DESELECT")
        bm = bmesh.from_edit_mesh(obj.data)
        number = bm.faces.layers.int["wcd_part"]
        for face in [face for face in bm.faces if face[number] == 0][:40]:
            face.select_set(True)
        bmesh.update_edit_mesh(obj.data)
        bpy.ops.ed.undo_push(message="Select")
    tables = [table()]
    calls = (
        (bpy.ops.wcd.assign_faces, {}),
        (bpy.ops.wcd.smooth_seams, {"scope": "ALL", "smoothness": 20.0}),
    )
    for call, values in calls:
        with hands.context():
            call("INVOKE_DEFAULT", True, **values)
        yield lambda: running.current is None
        yield 0.5
        tables.append(table())
    assert tables[0] != tables[1] != tables[2] != tables[0]
    undo, redo = "ctrl+z", "ctrl+shift+z"
    steps = ((undo, 1), (redo, 2), (undo, 1), (undo, 0), (redo, 1))
    for key, expected in steps:
        yield from hands.press(key)
        yield 0.7
        assert table() == tables[expected], (key, expected)
    hands.picture("assigned")
    yield from hands.press("Tab")
    yield lambda: mode() == "OBJECT"
    assert table() == tables[1]
    check_in_step(bpy.context.active_object)
    assert leftovers() == []


def clear_and_undo(hands):
    """Clear in Edit Mode; undo brings back groups, slots and notes with the faces."""
    yield from hands.parted_suzanne(1, samples=300)
    area = hands.area
    yield from hands.move(area.x + area.width // 4, area.y + area.height // 2)
    with hands.context():  # the copy shares materials, so Clear removes none of them
        bpy.ops.object.duplicate("INVOKE_DEFAULT", True)
    yield from hands.press("Tab")
    yield lambda: bpy.context.active_object.mode == "EDIT"
    states = [state()]
    with hands.context():
        bpy.ops.wcd.clear("INVOKE_DEFAULT", True)
    yield 0.5
    states.append(state())
    assert not bpy.context.active_object.vertex_groups
    for key, expected in (("ctrl+z", 0), ("ctrl+shift+z", 1), ("ctrl+z", 0)):
        yield from hands.press(key)
        yield 0.5
        found = state()
        for kind, value in states[expected].items():
            assert found[kind] == value, (key, kind)
    hands.picture("back")
    with hands.context():
        bpy.ops.object.mode_set(mode="OBJECT")
        bpy.ops.wcd.decompose("EXEC_DEFAULT", samples=300)
    assert leftovers() == []
