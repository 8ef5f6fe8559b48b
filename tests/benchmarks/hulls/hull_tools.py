"""Hulls of one mesh by one tool: python hull_tools.py TOOL MESH RESULT.npz [HULLS].

Each runs in a process of its own: CoACD and bpy in one may crash it.
"""

import sys
import time
from pathlib import Path

import numpy as np

# As many as CoACD and V-HACD may give.
MOST_VERTICES = 256
# Cut and joined down to the number of hulls asked for, whatever the error is then.
LEAST_ERROR = 0.01


def coacd(vertices, triangles, threshold):
    import coacd as tool

    tool.set_log_level("error")
    started = time.process_time()
    hulls = tool.run_coacd(tool.Mesh(vertices, triangles), threshold=threshold)
    return [hull[0] for hull in hulls], time.process_time() - started


def vhacd(vertices, triangles, _):
    import vhacdx

    faces = np.column_stack([np.full(len(triangles), 3), triangles])
    started = time.process_time()
    hulls = vhacdx.compute_vhacd(vertices, faces.ravel().astype(np.uint32))
    return [np.asarray(hull[0]) for hull in hulls], time.process_time() - started


def ours(vertices, triangles, n_hulls):
    import checkout  # noqa: F401  # makes the package importable
    from computed import build_hulls
    from weak_convex_decomposition.core.geometry.mesh import TriangleMesh

    # Where SciPy is loaded does not count for any tool.
    from weak_convex_decomposition.core.parameters.hulls import HullParameters

    mesh = TriangleMesh(vertices, triangles, np.arange(len(triangles)))
    parameters = HullParameters(
        max_hulls=int(n_hulls), max_error=LEAST_ERROR, max_vertices=MOST_VERTICES
    )
    started = time.process_time()
    found = build_hulls(mesh, parameters)
    seconds = time.process_time() - started
    return [shape.hull.vertices for shape in found.shapes], seconds


TOOLS = {
    "coacd-0.05": (coacd, 0.05),
    "coacd-0.1": (coacd, 0.1),
    "vhacd": (vhacd, None),
    "ours": (ours, None),
}


def main(tool, mesh, result, n_hulls=None):
    with np.load(mesh) as arrays:
        vertices, triangles = arrays["vertices"], arrays["triangles"]
    function, value = TOOLS[tool]
    hulls, seconds = function(vertices, triangles, n_hulls if value is None else value)
    arrays = {f"hull{number:03d}": hull for number, hull in enumerate(hulls)}
    np.savez(Path(result), seconds=seconds, **arrays)


if __name__ == "__main__":
    main(*sys.argv[1:])
