"""Notes that somebody edited by hand, to whatever, are not read as ours."""

import json

import bpy
import pytest
from hand_made import decompose_by_hand
from weak_convex_decomposition.ui.panels import notes_of, result_of

HULL = ("hulls", "hulls", 0)
RECORD = [
    (("parts",), {"a": 1}),
    (("parts", 0), 7),
    (("parts", 0), {"name": "Part 01"}),
    (("parts", 0, "number"), "0"),
    (("parts", 0, "color"), [1.0]),
    (("parts", 0, "faces"), None),
    (("psi_by_k", "1"), []),
    (("psi_by_k",), {"one": 0.5}),
    (("measured",), 0.5),
    (("hulls",), None),
    (("hulls", "hulls"), "none"),
    (HULL, "UCX_01"),
    ((*HULL, "name"), 1),
    ((*HULL, "volume"), "large"),
]
RESTORE = [
    (("groups",), 3),
    (("groups", 0), ["Part 01"]),
    (("active_slot",), "first"),
    (("tagged",), None),
]
CASES = [("wcd", *each) for each in RECORD] + [
    ("wcd_restore", *each) for each in RESTORE
]


@pytest.fixture
def full(suzanne):
    """Return an object with parts, hulls and a measurement."""
    bpy.ops.wcd.measure(samples=60)
    decompose_by_hand(suzanne, 3)
    bpy.ops.wcd.build_hulls(max_hulls=1, max_error=1.0, error_unit="SCENE")
    return suzanne


@pytest.mark.parametrize(("name", "path", "value"), CASES)
def test_notes_of_another_form_are_refused_in_a_sentence(full, name, path, value):
    owner = full if name == "wcd" else full.data
    noted = inner = json.loads(owner[name])
    for key in path[:-1]:
        inner = inner[key]
    inner[path[-1]] = value
    owner[name] = json.dumps(noted)
    sentence = (
        f"{owner.name} has a custom property {name} that this add-on did not write"
    )
    hull = {"hull": "Suzanne hull 01", "shape": "BOX"}
    works = {"clear": {}, "remove_hulls": {}, "refit_hull": hull, "refresh_parts": {}}
    works["build_hulls"] = {"pieces": "PARTS"}
    hulls = full.children[:]
    for work in ("clear", "refresh_parts") if owner != full else works:
        with pytest.raises(RuntimeError, match=sentence):
            getattr(bpy.ops.wcd, work)(**works[work])
    assert full.children[:] == hulls
    if owner == full:
        assert (result_of(full), notes_of(full)) == ({}, [])
