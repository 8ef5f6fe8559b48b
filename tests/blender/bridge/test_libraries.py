"""Libraries are loaded in slices while Blender waits, and on the way by a run."""

import subprocess
import sys

import bpy
import pytest
from weak_convex_decomposition.core.errors import DecompositionError
from weak_convex_decomposition.core.steps.progress import run
from weak_convex_decomposition.operators.bridge.work import libraries

NAMES = ("wcd_first_library", "wcd_second_library")
# What is left over after the slices of the libraries would be loaded all at once.
LEFT_OVER = """
import checkout, sys
from importlib import import_module
from weak_convex_decomposition.operators.bridge.work import libraries

for name in libraries._LIBRARIES:
    import_module(name)
before = set(sys.modules)
for name in libraries.core.MODULES:
    import_module(name)
print(*(name for name in set(sys.modules) - before if "weak" not in name))
"""


@pytest.fixture
def two_libraries(tmp_path, monkeypatch):
    """Let the core need two small modules and nothing else."""
    for name in NAMES:
        (tmp_path / f"{name}.py").touch()
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.setattr(libraries, "_LIBRARIES", NAMES)
    yield tmp_path
    libraries.stop()
    for name in NAMES:
        sys.modules.pop(name, None)


def loaded():
    return [name for name in NAMES if name in sys.modules]


def waits():
    return bpy.app.timers.is_registered(libraries._load_next)


def test_each_call_of_the_timer_loads_one(two_libraries):
    run(libraries.load_libraries())  # the core, too
    for name in NAMES:
        del sys.modules[name]
    assert libraries._load_next() < 1
    assert loaded() == [NAMES[0]]
    assert libraries._load_next() < 1
    assert loaded() == [*NAMES]
    assert libraries._load_next() is None


def test_a_run_loads_the_rest_and_nothing_waits_after_it(two_libraries):
    libraries.load_while_idle()
    assert waits()
    assert loaded() == []
    libraries._load_next()
    assert len(list(libraries.load_libraries())) >= 1
    assert loaded() == [*NAMES]
    assert libraries._load_next() is None
    libraries.stop()
    libraries.load_while_idle()
    assert not waits()


def test_unregistering_stops_it(two_libraries):
    libraries.load_while_idle()
    libraries.stop()
    assert not waits()
    libraries.stop()


def test_a_missing_library_is_said_by_the_run_alone(two_libraries):
    (two_libraries / f"{NAMES[1]}.py").write_text("import nothing_of_that_name")
    libraries._load_next()
    assert libraries._load_next() > 1
    with pytest.raises(DecompositionError, match="nothing_of_that_name"):
        run(libraries.load_libraries())


def test_nothing_is_left_for_the_core_to_load():
    done = subprocess.run(
        [sys.executable, "-c", f"import bpy\n{LEFT_OVER}"],
        capture_output=True,
        text=True,
        check=True,
        env={"PYTHONPATH": "tests/support"},
    )
    assert not [
        name
        for name in done.stdout.split()
        if name.partition(".")[0] in ("scipy", "sklearn", "threadpoolctl")
    ]
