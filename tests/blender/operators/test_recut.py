"""New parts as settings change, and by the chart."""

import bpy
import pytest
import weak_convex_decomposition as package
from edited import check_in_step, faces_by_name, needless_change, record_of
from hand_made import face_values
from snapshot import snapshot
from weak_convex_decomposition.core.parameters.parts import Parameters
from weak_convex_decomposition.core.parts.seams import cutter
from weak_convex_decomposition.core.steps.job import Job
from weak_convex_decomposition.operators import recut
from weak_convex_decomposition.operators.bridge.work import run_edit, session_cache
from weak_convex_decomposition.operators.running import ahead
from weak_convex_decomposition.operators.settings import RECUT

# A value of each setting that a live object follows.
CHANGES = {
    "parts": 3,
    "alpha": 1.0,
    "normalization": "STOCHASTIC",
    "min_parts": 3,
    "max_parts": 7,
    "refinement": "EMBEDDING",
    "smoothness": 0.0,
    "seams": "CUT",
    "bends": "KEEP",
    "smallest_part": 0.1,
    "levels": 2,
}


@pytest.fixture
def settings(suzanne):
    settings = bpy.context.scene.wcd
    settings.samples = 200
    bpy.ops.wcd.decompose(samples=200)
    settings.live = True
    return settings


def test_every_setting_of_a_cut_is_tried():
    assert list(CHANGES) == list(RECUT)


@pytest.mark.parametrize("name", CHANGES)
def test_a_live_setting_gives_what_a_run_gives(suzanne, settings, name):
    setattr(settings, name, CHANGES[name])
    live = snapshot(suzanne)
    assert record_of(suzanne)["parameters"][name] == CHANGES[name]
    settings.live = False
    bpy.ops.wcd.decompose(samples=200, **{name: CHANGES[name]})
    assert snapshot(suzanne) == live


def test_sliders_wait_less_where_writing_takes_longer(suzanne, settings, monkeypatch):
    def moment(n_faces, n_parts):
        noted = {"parts": [{"faces": n_faces / 2}] * 2}
        monkeypatch.setattr(recut, "record_of", lambda obj: noted)
        return recut._moment(suzanne, Parameters(parts=n_parts))

    most, least = recut._MOMENT
    assert moment(100, 2) == most > moment(126_000, 2) > moment(126_000, 20) > least
    assert moment(10**7, 2) == least
    assert moment(126_000, 0) == moment(126_000, 2)  # as many as there are


def test_nothing_happens_unless_live(suzanne, settings):
    settings.live = False
    before = snapshot(suzanne)
    settings.parts = 3
    assert snapshot(suzanne) == before
    settings.live = True  # catches up
    assert record_of(suzanne)["k"] == 3


def test_settings_change_nothing_without_parts(suzanne, settings):
    bpy.ops.mesh.primitive_cube_add()
    settings.parts = 3
    assert "wcd" not in bpy.context.active_object
    bpy.context.view_layer.objects.active = None
    settings.parts = 4


def test_other_settings_wait_for_the_next_cut(suzanne, settings):
    before = snapshot(suzanne)
    settings.seed = 1  # asks for other samples
    assert snapshot(suzanne) == before
    settings.parts = 3
    parameters = record_of(suzanne)["parameters"]
    assert (parameters["seed"], parameters["parts"]) == (1, 3)


def test_settings_that_contradict_each_other_change_nothing(suzanne, settings):
    before = snapshot(suzanne)
    settings.min_parts = 120
    assert snapshot(suzanne) == before


def counted(monkeypatch, owner, name):
    """Return a list that gets an entry with each call of a function."""
    calls, function = [], getattr(owner, name)

    def call(*args):
        calls.append(name)
        return function(*args)

    monkeypatch.setattr(owner, name, call)
    return calls


def test_a_preset_cuts_once(suzanne, settings, monkeypatch):
    settings.parts = 3
    settings.alpha = 1.0
    calls = counted(monkeypatch, recut.WCD_OT_recut, "_cut")
    bpy.ops.wcd.use_preset(preset="DEFAULT")
    assert settings.live
    assert len(calls) == 1
    settings.samples = 200
    settings.parts = 4
    assert record_of(suzanne)["parameters"]["alpha"] == 2.0


def test_the_chart_chooses_a_number(suzanne, settings):
    settings.live = False
    first = record_of(suzanne)
    for k in (1, 3, 6):
        assert bpy.ops.wcd.choose_part_count(parts=k) == {"FINISHED"}
        assert settings.parts == k
        chosen = record_of(suzanne)
        assert (chosen["k"], len(chosen["parts"])) == (k, k)
        assert chosen["psi_by_k"] == first["psi_by_k"]
        assert chosen["best_k"] == first["best_k"] == first["k"]


@pytest.mark.parametrize("live", [True, False])
def test_the_chart_writes_once(suzanne, settings, monkeypatch, live):
    settings.live = live
    calls = counted(monkeypatch, run_edit, "write_parts")
    bpy.ops.wcd.choose_part_count(parts=3)
    assert (settings.parts, record_of(suzanne)["k"], len(calls)) == (3, 3, 1)


def test_live_needs_no_window(suzanne, settings, capfd):
    with bpy.context.temp_override(window=None):
        settings.parts = 3
        bpy.ops.wcd.choose_part_count(parts=4)
        settings.auto_parts = False
    assert record_of(suzanne)["k"] == 4
    assert "Traceback" not in "".join(capfd.readouterr())


def test_work_that_waits_for_a_window_ends_with_its_file(suzanne, settings):
    for end in (lambda: bpy.ops.wm.read_homefile(use_empty=True), package.unregister):
        recut._half_found = "key", Job(iter(()))
        end()
        assert recut._half_found is None
    package.register()


def test_the_chart_needs_parts(suzanne):
    with pytest.raises(RuntimeError, match="no parts to replace; press Decompose"):
        bpy.ops.wcd.choose_part_count(parts=3)


def labels(obj):
    return [each.value for each in obj.data.attributes["wcd_part"].data]


@pytest.mark.parametrize("slices", [1, 10_000])
def test_parts_found_ahead_are_those_of_a_run(suzanne, settings, monkeypatch, slices):
    settings.parts = 4
    for _ in range(slices):
        if ahead.go_on() is None:
            break
    if slices > 1:  # nothing is left to be cut for any usual number
        monkeypatch.setattr(cutter, "cut_seams", None)
    for parts in (5, 3, 6, 2, *((13, 20) if slices > 1 else ())):
        settings.parts = parts
        assert record_of(suzanne)["k"] == parts
    monkeypatch.undo()
    settings.parts = 5
    found = labels(suzanne)
    settings.live = False
    session_cache.forget()
    bpy.ops.wcd.decompose(samples=200, parts=5)
    assert labels(suzanne) == found


def test_parts_are_found_ahead_from_the_first_run_on(suzanne):
    ahead.stop()
    bpy.ops.wcd.decompose(samples=200, parts=4)
    assert ahead.go_on() is not None


def test_parts_of_a_large_mesh_are_found_ahead_for_near_numbers(suzanne, monkeypatch):
    monkeypatch.setattr(ahead, "_MOST_FACES", 100)
    bpy.ops.wcd.decompose(samples=200, parts=4)
    exact = [each.parts for each, is_look in ahead._wanted if not is_look]
    assert exact == [5, 3, 6, 2]


def test_nothing_is_found_ahead_after_a_file_is_loaded(suzanne, settings):
    settings.parts = 4
    ahead.go_on()
    bpy.ops.wm.read_homefile(use_empty=True)
    assert ahead.go_on() is None


def test_nothing_is_found_ahead_where_parts_stay(suzanne, settings):
    ahead.stop()
    suzanne.wcd_parts[0].locked = True
    settings.parts = 4
    assert ahead.go_on() is None


@pytest.mark.parametrize("by", ["chart", "live"])
def test_names_and_a_lock_stay_from_3_to_12_parts(suzanne, settings, by):
    settings.live = False
    bpy.ops.wcd.choose_part_count(parts=3)
    for row, name in zip(suzanne.wcd_parts, ("Head", "Jaw", "Ear"), strict=True):
        row.name = name
    suzanne.wcd_parts[1].locked = True
    locked = face_values(suzanne.data, "wcd_part") == suzanne.wcd_parts[1].number
    settings.live = by == "live"
    for n_parts in (*range(3, 13), *range(11, 2, -1)):
        before = faces_by_name(suzanne)
        if by == "live":
            settings.parts = n_parts
        else:
            bpy.ops.wcd.choose_part_count(parts=n_parts)
        rows = {row.name: row for row in suzanne.wcd_parts}
        assert len(rows) == n_parts
        assert needless_change(suzanne, before, faces_by_name(suzanne)) <= 0.02
        assert [name for name, row in rows.items() if row.locked] == ["Jaw"]
        parts = face_values(suzanne.data, "wcd_part")
        assert ((parts == rows["Jaw"].number) == locked).all()
    check_in_step(suzanne)
