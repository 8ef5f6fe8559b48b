"""Hulls built in other processes are those built in this one."""

import os
import sys
import time

import numpy as np
import pytest
import shapes
from weak_convex_decomposition.core.cache import ShapeCache, no_rays
from weak_convex_decomposition.core.errors import DecompositionError
from weak_convex_decomposition.core.geometry.point_cloud import PointCloud
from weak_convex_decomposition.core.hulls.build import build_hulls_in_steps
from weak_convex_decomposition.core.parameters.hulls import HullParameters
from weak_convex_decomposition.core.steps.processes import Processes, available
from weak_convex_decomposition.core.steps.progress import run


def two_processes():
    made = Processes(2)
    yield made
    made.close()


# They start when they are needed, which takes seconds: tests that leave them as they
# are, and ask for hulls that no other test asks for, share them.
shared = pytest.fixture(two_processes, scope="module")
processes = pytest.fixture(two_processes)


def task(shape):
    return build_hulls_in_steps, shape, HullParameters(), ShapeCache(no_rays)


def here(shape):
    compute, *arguments = task(shape)
    return run(compute(*arguments))


def assert_same(one, other):
    assert one.n_hulls == other.n_hulls
    assert (one.errors == other.errors).all()
    for mine, yours in zip(one.shapes, other.shapes, strict=True):
        assert (mine.hull.vertices == yours.hull.vertices).all()


def pid_of_first(processes):
    """Return the number of the process that was started first, once it is."""
    while not processes._started:
        time.sleep(0.01)
    return processes._started[0].pid


def test_the_hulls_are_the_same(shared):
    meshes = [shapes.l_prism(arm) for arm in (2.0, 3.0, 4.0)]
    steps = [shared.steps("Cutting", *task(mesh)) for mesh in meshes]
    for mesh, found in zip(meshes, [run(each) for each in steps], strict=True):
        assert_same(found, here(mesh))
    assert len(shared._started) == 2


def test_equal_calls_get_one_answer(shared):
    steps = [
        shared.steps("Cutting", *task(shapes.l_prism(arm))) for arm in (2.5, 2.5, 3.5)
    ]
    one, two, other = [run(each) for each in steps]
    assert one is two
    assert one.volume_ratio == here(shapes.l_prism(2.5)).volume_ratio
    assert other.shapes[0].volume != one.shapes[0].volume


def test_errors_come_back(shared):
    cloud = PointCloud(np.random.default_rng(0).random((50, 3)))
    with pytest.raises(DecompositionError, match="A cloud has no faces"):
        run(shared.steps("Cutting", *task(cloud)))
    mesh = shapes.l_prism(4.5)
    assert_same(run(shared.steps("Cutting", *task(mesh))), here(mesh))
    assert all(process.poll() is None for process in shared._started)


def test_without_processes_this_one_computes(processes, monkeypatch):
    monkeypatch.setattr(sys, "executable", "/no/such/python")
    mesh = shapes.l_prism()
    for _ in range(3):
        assert_same(run(processes.steps("Cutting", *task(mesh))), here(mesh))


def test_a_process_that_dies_is_made_up_for(processes):
    mesh = shapes.l_prism()
    steps = [processes.steps("Cutting", *task(mesh)) for _ in range(4)]
    os.kill(pid_of_first(processes), 9)
    for each in steps:
        assert_same(run(each), here(mesh))


def test_closing_ends_processes_at_work(processes):
    for _ in range(8):
        processes.steps("Cutting", *task(shapes.comb()))
    pid = pid_of_first(processes)
    processes.close()
    with pytest.raises(ProcessLookupError):
        os.kill(pid, 0)


def test_modules_of_the_current_folder_are_left_alone(processes, tmp_path, monkeypatch):
    mark = tmp_path / "mark"
    (tmp_path / "pickle.py").write_text(f"open({str(mark)!r}, 'w')")
    monkeypatch.chdir(tmp_path)
    mesh = shapes.l_prism()
    assert_same(run(processes.steps("Cutting", *task(mesh))), here(mesh))
    assert not mark.exists()


def test_there_is_a_processor():
    assert 1 <= available() <= 8
