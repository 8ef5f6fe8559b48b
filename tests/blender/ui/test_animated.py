"""Nothing of ours is animated: Blender would set it on its own copy of an object.

With a keyframe on the color of a part, it counted the part's material as unused.
"""

import bpy
import pytest
from weak_convex_decomposition.operators.bridge.parts.rows import WCD_PG_part
from weak_convex_decomposition.operators.scene_settings import WCD_PG_settings


@pytest.mark.parametrize("cls", [WCD_PG_part, WCD_PG_settings])
def test_rows_and_settings_take_no_keyframes(monkey, cls):
    owner = monkey.wcd_parts[0] if cls == WCD_PG_part else bpy.context.scene.wcd
    for name in cls.__annotations__:
        for animate in (owner.keyframe_insert, owner.driver_add):
            with pytest.raises(TypeError, match="not animatable"):
                animate(name)


def test_the_highlighted_row_takes_none(monkey):
    with pytest.raises(TypeError, match="not animatable"):
        monkey.keyframe_insert("wcd_active_part")
