"""Options that need others, and numbers below 0."""

import bpy
import pytest
from hand_made import decompose_by_hand, mesh_object
from headless.command import run_wcd
from weak_convex_decomposition.operators.headless.request.options import parse

ANGLES = "--cone-angle, --psi-pairs change nothing without --sight cone."


@pytest.mark.parametrize(
    ("options", "notes"),
    [
        ("--cone-angle=50 --psi-pairs=rays", (ANGLES,)),
        ("--cone-angle=50 --psi-pairs=rays --sight=cone", ()),
        ("--preset=paper --cone-angle=50", ()),
        (
            "--parts=3 --min-parts=2",
            ("--min-parts changes nothing without --parts 0.",),
        ),
        ("--min-parts=2", ()),
        ("--samples=90 --sampling=faces", ("--samples changes nothing without",)),
        ("--hulls=b.glb --max-error=.1", ()),
        ("--hulls=b.glb --pieces=parts --max-error=.1", ("--max-error changes",)),
        ("--hulls=b.glb --shape=box --max-vertices=9", ("--max-vertices changes",)),
        ("b.blend --hulls={name}.obj --pieces=parts --shape=box --max-vertices=9", ()),
        (
            "b.blend --hulls={name}.obj --shape=box --max-vertices=9",
            ("--max-vertices",),
        ),
        ("--hulls=b.glb --cone-angle=50", ("--cone-angle changes nothing for hulls",)),
    ],
)
def test_options_that_need_another_value_of_another(options, notes):
    words = ["a.off", *options.split(), "--output={name}.glb"]
    if "for hulls" in "".join(notes):
        words.remove("--output={name}.glb")
    found = parse(words, "wcd").notes
    assert len(found) == len(notes)
    assert all(map(str.startswith, found, notes))


@pytest.mark.parametrize("number", ["-1e-3", "-.5", "-2"])
def test_negative_numbers_are_values(number):
    request = parse(["a.off", "--hulls", "b.glb", "--margin", number], "wcd")
    assert request.hull_parameters.margin == float(number)


def test_a_negative_number_is_no_value_of_what_takes_none(capsys):
    with pytest.raises(SystemExit):
        parse(["a.off", "--margin", "--quiet"], "wcd")
    assert "--margin: expected one argument" in capsys.readouterr().err


@pytest.mark.parametrize(("option", "is_named"), [("--alpha=1", 1), ("--seed=1", 0)])
def test_objects_that_keep_their_parts_are_named(tmp_path, capsys, option, is_named):
    points = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
    faces = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
    decompose_by_hand(mesh_object("Solid", points, faces), 2)
    path = tmp_path / "a.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path), copy=True)
    words = [str(path), f"--hulls={tmp_path / 'h.glb'}", "--pieces=parts", option]
    assert run_wcd(*words, "--quiet") == 0
    said = capsys.readouterr().err
    assert said.count("Solid: It keeps its parts; options that find") == is_named


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        ("--hulls a.xml --hulls b.xml", "argument --hulls: it is given twice"),
        ("--output=a.glb --output=a.glb", "argument --output: it is given twice"),
        ("--report r.json --report=-", "argument --report: it is given twice"),
        ("--report o/{name}.json", "leave {name} out of --report"),
        ("--output={Name}.glb", "--output has {Name} in it; write {name}"),
        ("--hulls={stem}_{name}.glb", "--hulls has {stem} in it; write {name}"),
        ("--output=a.glb/", "argument --output: a.glb/ is a folder; name a file"),
        ("--report=r.json/", "argument --report: r.json/ is a folder; name a file"),
    ],
)
def test_outputs_are_not_dropped_or_named_by_chance(options, sentence, capsys):
    with pytest.raises(SystemExit):
        parse(["a.off", *options.split()], "wcd")
    assert sentence in capsys.readouterr().err


def test_an_empty_input_is_no_folder(capsys):
    with pytest.raises(SystemExit):
        parse(["a.off", ""], "wcd")
    assert "argument INPUT: it is empty; name a file" in capsys.readouterr().err


def test_a_setting_may_be_given_again():
    assert parse(["a.off", "--parts=2", "--parts=3"], "wcd").parameters.parts == 3
