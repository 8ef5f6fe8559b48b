"""Keep one cache per session, so that decomposing the same shape again is quick.

It holds arrays and a ray tree, and no data of the file. Shapes are compared by content,
so that no change goes unnoticed. The figures of the latest mesh are forgotten with it.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from .... import core
from ..mesh import known
from ..rays.bvh import BvhRayCaster

# Most results that are kept while files are worked through.
_RESULTS = 64
_n_results = 0
_cache: core.ShapeCache | None = None


def session_cache() -> core.ShapeCache:
    """Return the cache of the session. The first call makes it, and loads SciPy."""
    global _cache
    if _cache is None:
        _cache = core.ShapeCache(BvhRayCaster, _n_results)
    return _cache


@contextmanager
def results_kept() -> Iterator[None]:
    """Keep the latest results of small shapes: files have many equal objects.

    In a window, what is asked for next is another cut of the latest shape. More is kept
    for that than its result.
    """
    global _n_results
    _n_results = _RESULTS
    forget()
    try:
        yield
    finally:
        _n_results = 0
        forget()


def forget(*_: object) -> None:
    """Empty the cache. Blender passes arguments to handlers; they are ignored."""
    global _cache
    _cache = None
    known.forget()


stop = forget  # when the extension or Python ends
HANDLERS = {"load_pre": forget}
