"""The tab loads SciPy and scikit-learn in slices; nothing is loaded before it shows."""

import sys

import bpy
from weak_convex_decomposition.operators.bridge.work import libraries

LAST = libraries._LIBRARIES[-1]


def waits():
    return bpy.app.timers.is_registered(libraries._load_next)


def steps(hands):
    yield 1.0
    assert not waits()
    assert LAST not in sys.modules
    yield from hands.open_sidebar()
    yield waits
    yield lambda: not waits()
    assert LAST in sys.modules
    hands.region().tag_redraw()
    yield 0.5
    assert not waits()
    hands.picture("loaded", hands.region())
