"""Ctrl-C, SIGTERM and SIGHUP at any time: what is done is reported."""

import json
import os
import shutil
import signal
import time
from pathlib import Path

import bpy
import pytest
from headless.command import QUICK, content, run_wcd, start
from weak_convex_decomposition.operators.headless import command_line
from weak_convex_decomposition.operators.headless.read import load
from weak_convex_decomposition.operators.headless.write import model_files

SIGNALS = [signal.SIGINT, signal.SIGTERM, signal.SIGHUP]


@pytest.fixture
def model(tmp_path):
    bpy.ops.mesh.primitive_cube_add()
    (tmp_path / "in").mkdir()
    bpy.ops.wm.ply_export(filepath=str(tmp_path / "in" / "a.ply"))
    for name in ("b", "c"):
        shutil.copy(tmp_path / "in" / "a.ply", tmp_path / "in" / f"{name}.ply")
    return tmp_path / "in" / "a.ply"


@pytest.mark.parametrize("number", SIGNALS)
def test_the_report_has_what_was_finished(tmp_path, model, monkeypatch, capfd, number):
    decompose_file = command_line.decompose_file

    def interrupted(path, *rest):
        if path.stem == "b":
            os.kill(os.getpid(), number)
            time.sleep(10)
        return decompose_file(path, *rest)

    monkeypatch.setattr(command_line, "decompose_file", interrupted)
    handlers = [signal.getsignal(each) for each in SIGNALS]
    inputs = [str(model.with_stem(name)) for name in "abc"]
    outputs = ["--output", f"{tmp_path}/{{name}}.glb", "--report", f"{tmp_path}/r.json"]
    capfd.readouterr()
    assert run_wcd(*inputs, *outputs, *QUICK, "--quiet") == 130
    assert capfd.readouterr().err.endswith("error: Interrupted.\n")
    report = json.loads((tmp_path / "r.json").read_text())
    assert report["interrupted"] is True
    assert report["not_done"] == inputs[1:]
    assert [entry["input"] for entry in report["inputs"]] == inputs[:1]
    assert sorted(content(tmp_path)) == sorted(
        ["a.glb", "r.json", "in/a.ply", "in/b.ply", "in/c.ply"]
    )
    after = [signal.getsignal(each) for each in SIGNALS]
    assert after == handlers


def test_a_terminal_that_closes_sends_two_signals(tmp_path, model, monkeypatch):
    report = command_line._report

    def interrupted(*arguments):
        os.kill(os.getpid(), signal.SIGHUP)
        report(*arguments)

    monkeypatch.setattr(command_line, "_report", interrupted)
    monkeypatch.setattr(
        command_line,
        "decompose_file",
        lambda *_: os.kill(os.getpid(), signal.SIGHUP) or time.sleep(10),
    )
    assert run_wcd(model, f"--report={tmp_path / 'r.json'}", *QUICK) == 130
    assert json.loads((tmp_path / "r.json").read_text())["interrupted"] is True


class WCD_OT_interrupted(bpy.types.Operator):
    bl_idname = "wcd.interrupted"
    bl_label = "Exporter in Python that the user stops"

    def execute(self, context):
        os.kill(os.getpid(), signal.SIGINT)
        time.sleep(10)
        return {"FINISHED"}


@pytest.mark.parametrize("module", [model_files, load])
def test_an_operator_in_python_does_not_lose_it(tmp_path, model, monkeypatch, module):
    bpy.utils.register_class(WCD_OT_interrupted)
    known = module.IMPORTERS if module is load else module._EXPORTERS
    monkeypatch.setitem(known, ".ply", lambda path, up: bpy.ops.wcd.interrupted())
    words = [str(model), "b.ply", f"--output={tmp_path}/out/{{name}}.ply", "--quiet"]
    report = tmp_path / "r.json"
    assert run_wcd(*words, f"--report={report}", *QUICK) == 130
    bpy.utils.unregister_class(WCD_OT_interrupted)
    assert json.loads(report.read_text())["not_done"] == [str(model), "b.ply"]
    assert not (tmp_path / "out").exists()


def test_a_report_of_all_is_not_interrupted(tmp_path, model):
    report = tmp_path / "r.json"
    assert run_wcd(model, "--report", report, *QUICK, "--quiet") == 0
    found = json.loads(report.read_text())
    assert (found["interrupted"], found["not_done"]) == (False, [])


@pytest.mark.parametrize("name", [each.name for each in SIGNALS])
def test_while_a_library_is_imported(tmp_path, model, name):
    """The signal comes exactly there, on every computer."""
    (tmp_path / "slow").mkdir()
    (tmp_path / "slow" / "bpy.py").write_text(
        "import os, signal, time\n"
        "try:\n"
        f"    os.kill(os.getpid(), signal.{name})\n"
        "    time.sleep(10)\n"
        "except BaseException as error:\n"
        "    raise ImportError('the interrupt is lost') from error\n"
    )
    process = start(model, environment={"PYTHONPATH": str(tmp_path / "slow")})
    out, err = process.communicate(timeout=60)
    assert (process.returncode, out, err) == (130, "", "error: Interrupted.\n")


@pytest.mark.parametrize("number", SIGNALS)
def test_while_blender_is_loaded(tmp_path, model, number):
    words = [model, "--output", tmp_path / "a.glb", *QUICK, "--quiet"]
    process = start(*words)
    while "site-packages/bpy/" not in Path(f"/proc/{process.pid}/maps").read_text():
        time.sleep(0.005)
    process.send_signal(number)
    out, err = process.communicate(timeout=60)
    assert (process.returncode, out, err) == (130, "", "error: Interrupted.\n")
    assert sorted(content(tmp_path)) == ["in/a.ply", "in/b.ply", "in/c.ply"]


def test_an_interrupt_that_is_ignored_stays_so(tmp_path, model):
    words = [model, "--report", tmp_path / "r.json", *QUICK]
    process = start(
        *words, preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_IGN)
    )
    while process.poll() is None:
        process.send_signal(signal.SIGINT)
        time.sleep(0.1)
    assert process.returncode == 0, process.communicate()
    process.communicate()
    assert (tmp_path / "r.json").exists()
