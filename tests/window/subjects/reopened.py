"""Parts are there in a file that another Blender has saved, and nothing complains."""

import bpy
import numpy as np
from edited import record_of
from hands import PICTURES
from leftovers import leftovers, remembered


def steps(hands):
    with hands.context():
        path = (PICTURES / "saved.blend").resolve()
        bpy.ops.wm.open_mainfile(filepath=str(path))
    yield 1.0
    obj = bpy.context.active_object
    record = record_of(obj)
    labels = np.zeros(len(obj.data.polygons), dtype=np.int32)
    obj.data.attributes["wcd_part"].data.foreach_get("value", labels)
    assert np.bincount(labels).tolist() == [p["faces"] for p in record["parts"]]
    assert [g.name for g in obj.vertex_groups] == [p["name"] for p in record["parts"]]
    assert remembered() == 0
    assert leftovers() == []
    yield from hands.open_sidebar()
    hands.picture("sidebar")
    yield from hands.find("wcd.choose_part_count")
