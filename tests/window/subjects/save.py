"""Parts are saved with the file that `reopened` opens."""

import bpy
from hands import PICTURES


def steps(hands):
    yield from hands.open_sidebar()
    hands.suzanne(1)
    with hands.context():
        bpy.ops.wcd.decompose(samples=300)
        PICTURES.mkdir(parents=True, exist_ok=True)
        path = (PICTURES / "saved.blend").resolve()
        bpy.ops.wm.save_as_mainfile(filepath=str(path))
    yield 0.3
