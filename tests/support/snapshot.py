"""Everything an add-on could leave behind on a mesh object, as plain values."""

import bpy

_FIELDS = {"FLOAT_VECTOR": "vector", "FLOAT2": "vector", "FLOAT_COLOR": "color"}
_FIELDS["BYTE_COLOR"] = "color"
_DEFINED = {"wcd_parts", "wcd_active_part"}


def snapshot(obj):
    """Return the state of an object, its mesh and the materials of the file."""
    return {
        "object": _object(obj),
        "sharers": [_object(o) for o in bpy.data.objects if o.data == obj.data],
        "mesh": _mesh(obj.data),
        "materials": [_material(material) for material in bpy.data.materials],
        "meshes": [mesh.name for mesh in bpy.data.meshes],
        "objects": [o.name for o in bpy.data.objects],
    }


def _object(obj):
    return {
        "name": obj.name,
        "mode": obj.mode,
        "selected": obj.select_get(),
        "matrix": [tuple(row) for row in obj.matrix_basis],
        "properties": _properties(obj),
        "slots": [(s.link, s.material and s.material.name) for s in obj.material_slots],
        "active_slot": obj.active_material_index,
        "groups": [(g.name, g.index, g.lock_weight) for g in obj.vertex_groups],
        "active_group": obj.vertex_groups.active_index,
        "rows": [(r.name, r.number, r.chosen, r.locked) for r in obj.wcd_parts],
        "active_row": obj.wcd_active_part,
        "modifiers": [(m.name, m.type) for m in obj.modifiers],
    }


def _mesh(mesh):
    return {
        "properties": _properties(mesh),
        "materials": [material and material.name for material in mesh.materials],
        "vertices": [tuple(v.co) for v in mesh.vertices],
        "weights": [[(g.group, g.weight) for g in v.groups] for v in mesh.vertices],
        "edges": [tuple(edge.vertices) for edge in mesh.edges],
        "polygons": [
            (tuple(p.vertices), p.material_index, p.select, p.use_smooth)
            for p in mesh.polygons
        ],
        "attributes": {a.name: _attribute(a) for a in mesh.attributes},
        "active_attribute": mesh.attributes.active and mesh.attributes.active.name,
        "shape_keys": mesh.shape_keys
        and [
            (key.name, key.value, [tuple(point.co) for point in key.data])
            for key in mesh.shape_keys.key_blocks
        ],
    }


def _attribute(attribute):
    field = _FIELDS.get(attribute.data_type, "value")
    values = [getattr(item, field) for item in attribute.data]
    return attribute.domain, attribute.data_type, [_plain(value) for value in values]


def _material(material):
    color = tuple(material.diffuse_color)
    return material.name, material.users, color, _properties(material)


def _properties(owner):
    # Before 5.0, Blender keeps what add-ons define among them: see "rows".
    keys = set(owner.keys()) - _DEFINED
    return {key: _plain(owner[key]) for key in sorted(keys)}


def _plain(value):
    if isinstance(value, bpy.types.ID):
        return value.name
    return value if isinstance(value, int | float | str | bytes) else tuple(value)
