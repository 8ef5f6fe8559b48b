"""An object with parts to edit, and what Blender's data say of them."""

import json

import numpy as np
from definitions import agreement
from hand_made import areas, face_values, in_mode
from weak_convex_decomposition.operators.bridge.parts.part_materials import (
    is_overlaid,
    kept_materials,
)
from weak_convex_decomposition.operators.bridge.stored.identity import has_name

# Of the visibility that edits are described by.
FAST = {"samples": 60, "containers": "HOLLOW", "max_parts": 4}


def labels_of(obj):
    """Return the place of each face's part in the record."""
    mode = obj.mode
    in_mode(obj, "OBJECT")
    labels = face_values(obj.data, "wcd_part")
    in_mode(obj, mode)
    numbers = [number for _, number, _ in parts_of(obj)]
    assert set(labels) <= set(numbers)
    return np.searchsorted(numbers, labels)


def record_of(obj):
    return json.loads(obj["wcd"])


def notes_of(obj):
    """Return the sentences in the record as one text."""
    return " ".join(record_of(obj)["notes"])


def parts_of(obj):
    """Return the name, number and material of each part, from the record."""
    keys = ("name", "number", "material")
    return [tuple(part[key] for key in keys) for part in record_of(obj)["parts"]]


def faces_by_name(obj):
    """Return the name of the part of each face."""
    return np.array([name for name, _, _ in parts_of(obj)])[labels_of(obj)]


def needless_change(obj, before, after):
    """Return the share of the area that changed its name, though it need not.

    `before` and `after` are names, or colors, of all faces.
    """
    sizes = areas(obj.data)
    changed = sizes[before != after].sum()
    _, before = np.unique(before, return_inverse=True)
    _, after = np.unique(after, return_inverse=True)
    return changed / sizes.sum() + agreement(before, after, sizes) - 1


def check_in_step(obj):
    """Check that groups, slots, faces, rows and record tell of the same parts."""
    mode = obj.mode
    in_mode(obj, "OBJECT")
    record, labels = record_of(obj), labels_of(obj)
    names = [part["name"] for part in record["parts"]]
    assert record["k"] == len(names) == len(set(names))
    numbers = [number for _, number, _ in parts_of(obj)]
    assert numbers == sorted(set(numbers))
    rows = [row for row in obj.wcd_parts if row.number in numbers]
    assert [(row.number, row.name) for row in rows] == list(
        zip(numbers, names, strict=True)
    )
    assert set(names) <= {group.name for group in obj.vertex_groups}
    counts = np.bincount(labels, minlength=len(names))
    assert [part["faces"] for part in record["parts"]] == counts.tolist()
    assert sum(part["faces"] for part in record["parts"]) == len(labels)
    belongs = {(names[i], v) for f, i in enumerate(labels) for v in vertices_of(obj, f)}
    groups = {group.index: group.name for group in obj.vertex_groups}
    weights = {(groups[g.group], v.index) for v in obj.data.vertices for g in v.groups}
    assert {pair for pair in weights if pair[0] in names} == belongs
    if is_overlaid(obj):
        kept = kept_materials(obj.data)
        assert not set(kept.values()) & set(obj.data.materials)
        slots = [kept[numbers[index]] for index in labels]
    else:
        slots = [obj.data.materials[p.material_index] for p in obj.data.polygons]
    assert [slot["wcd_part"] for slot in slots] == [numbers[index] for index in labels]
    assert [slot["wcd_name"] for slot in slots] == [names[index] for index in labels]
    assert all(has_name(s.name, s["wcd_name"]) for s in slots)
    in_mode(obj, mode)


def vertices_of(obj, face):
    return obj.data.polygons[face].vertices
