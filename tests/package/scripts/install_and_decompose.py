"""Install the zip argv[1], decompose Suzanne, and write what was seen to argv[2].

Her hulls are built as in a window if she were large: by another process.
"""

import json
import os
import sys
from importlib import import_module
from pathlib import Path

import bpy

MODULE = "bl_ext.user_default.weak_convex_decomposition"

zip_path, report_path = sys.argv[1:]
loaded_before = {"numpy", "scipy", "sklearn"} & set(sys.modules)
installed = bpy.ops.extensions.package_install_files(
    filepath=zip_path, repo="user_default", enable_on_install=True
)
enabled = MODULE in bpy.context.preferences.addons
loaded_by_enabling = ({"scipy", "sklearn"} & set(sys.modules)) - loaded_before

bpy.ops.mesh.primitive_monkey_add()
suzanne = bpy.context.active_object
finished = bpy.ops.wcd.decompose()
scipy, sklearn = sys.modules["scipy"], sys.modules["sklearn"]
labels = [item.value for item in suzanne.data.attributes["wcd_part"].data]

hulls = import_module(MODULE + ".operators.bridge.work.computing_hulls")
package = import_module(MODULE)
progress = import_module(MODULE + ".core.steps.progress")
answered = []


class Processes(hulls.Processes):
    """Notes whether a process has answered."""

    def _answer(self, *call):
        answer = super()._answer(*call)
        answered.append(answer is not None)
        return answer


hulls.Processes, hulls._MANY = Processes, 0
asked = package.Parameters(), package.HullParameters(max_hulls=4)
found = progress.run(hulls.build_hulls_of(suzanne, *asked, in_window=True))

report = {
    "installed": sorted(installed),
    "enabled": enabled,
    "loaded_by_enabling": sorted(loaded_by_enabling),
    "finished": sorted(finished),
    "scipy": [scipy.__file__, scipy.__version__],
    "sklearn": [sklearn.__file__, sklearn.__version__],
    "faces": len(suzanne.data.polygons),
    "labels": labels,
    "answered": answered,
    "hulls": found.n_hulls,
    "groups": [group.name for group in suzanne.vertex_groups],
}
Path(report_path).write_text(json.dumps(report), encoding="utf-8")

# Blender 4.2's wheel crashes where Python ends after an add-on was registered.
sys.stdout.flush()
os._exit(0)
