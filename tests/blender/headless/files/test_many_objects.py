"""Hulls of many objects are built in several processes: same files, no leftovers."""

import json
import os
import signal

import bpy
import pytest
from headless.command import QUICK, run_wcd
from weak_convex_decomposition.core import decomposition
from weak_convex_decomposition.core.hulls import build as hulls_of_shapes
from weak_convex_decomposition.core.steps import processes
from weak_convex_decomposition.operators.headless.run import hulls_ahead


@pytest.fixture
def model(tmp_path):
    """Return a file of four tori, the last with the mesh of the first, and a plane."""
    for place in range(3):
        bpy.ops.mesh.primitive_torus_add(
            major_segments=8, minor_segments=4, minor_radius=0.2 + 0.05 * place
        )
        bpy.context.object.location = (3 * place, 0, 0)
    torus = bpy.data.objects["Torus"].copy()
    torus.location, torus.scale = (0, 5, 0), (1, 1.2, 1)
    bpy.context.collection.objects.link(torus)
    bpy.ops.mesh.primitive_plane_add()
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "in.blend"), copy=True)
    return tmp_path / "in.blend"


@pytest.fixture
def started(monkeypatch):
    """Start processes at once; return those that were started."""
    monkeypatch.setattr(hulls_ahead, "_PATIENCE", 0.0)
    found, start = [], processes._start

    def starting():
        found.append(start())
        return found[-1]

    monkeypatch.setattr(processes, "_start", starting)
    return found


@pytest.fixture
def copies(tmp_path):
    """Return a file of three equal tori, each with a mesh and a size of its own."""
    for place in range(3):
        bpy.ops.mesh.primitive_torus_add(major_segments=8, minor_segments=4)
        bpy.context.object.location.x = 5 * place
        bpy.context.object.scale = [1 + place] * 3
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "in.blend"), copy=True)
    return tmp_path / "in.blend"


def build(model, name, *options):
    """Build hulls; return the status and the file."""
    file = model.with_name(name)
    status = run_wcd(model, "--hulls", file, *QUICK, *options)
    return status, file


@pytest.mark.parametrize("options", [(), ("--pieces=PARTS", "--output={name}-p.blend")])
def test_the_files_are_the_same(model, started, capsys, options):
    words = [word.replace("{name}", str(model.with_suffix(""))) for word in options]
    status, one = build(model, "one.obj", *words, "--processes=1")
    assert status == 0
    assert not started
    told = capsys.readouterr().out
    status, two = build(model, "two.obj", *words, "--processes=2")
    assert status == 0
    assert len(started) == 2
    assert one.read_bytes() == two.read_bytes()
    lines = [line.rpartition(",")[0] for line in told.splitlines()]  # without seconds
    after = capsys.readouterr().out.splitlines()
    assert [line.rpartition(",")[0] for line in after] == lines
    assert all(process.poll() is not None for process in started)


def test_equal_meshes_are_worked_on_once(copies, monkeypatch):
    calls = []

    def count(module, name):
        compute = getattr(module, name)
        counted = lambda *args: calls.append(name) or compute(*args)  # noqa: E731
        monkeypatch.setattr(module, name, counted)

    count(decomposition, "_decompose")
    count(hulls_of_shapes, "_build")
    report, parts = copies.with_name("r.json"), copies.with_name("parts.blend")
    words = f"--report={report}", f"--output={parts}", "--processes=1"
    assert build(copies, "one.obj", *words)[0] == 0
    assert calls == ["_decompose", "_build"]
    objects = json.loads(report.read_text())["inputs"][0]["objects"]
    assert [each["name"] for each in objects] == ["Torus", "Torus.001", "Torus.002"]
    assert len({each["psi"] for each in objects}) == 1
    hulls = [[hull["error"] for hull in each["hulls"]["hulls"]] for each in objects]
    assert hulls[0] == hulls[1] == hulls[2]
    # Where sizes matter, they are not equal.
    build(copies, "two.obj", "--processes=1", "--error-unit=scene")
    assert calls == ["_decompose", "_build"] + 3 * ["_build"]


def test_an_interrupt_leaves_no_process(model, started, monkeypatch, capfd):
    write = hulls_ahead.HullsAhead.steps_of

    def interrupted(self, obj):
        steps = write(self, obj)
        if obj.name == "Torus.001":
            os.kill(os.getpid(), signal.SIGINT)
        return steps

    monkeypatch.setattr(hulls_ahead.HullsAhead, "steps_of", interrupted)
    capfd.readouterr()
    status, file = build(model, "a.obj", "--quiet", "--processes=2")
    assert status == 130
    assert capfd.readouterr().err.endswith("\nerror: Interrupted.\n")
    assert not file.exists()
    assert started
    assert all(process.poll() is not None for process in started)
