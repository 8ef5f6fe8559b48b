import math

import pytest
from weak_convex_decomposition.core.errors import DecompositionError
from weak_convex_decomposition.core.parameters.parts import Parameters
from weak_convex_decomposition.core.parameters.presets import PRESETS, preset


def test_the_default_preset_is_the_defaults():
    assert preset("DEFAULT").parameters() == Parameters()


def test_presets_differ_and_explain_themselves():
    assert len({each.parameters() for each in PRESETS}) == len(PRESETS)
    assert len({each.identifier for each in PRESETS}) == len(PRESETS)
    assert all(each.label and each.help for each in PRESETS)


def test_no_preset_repeats_a_default():
    default = Parameters()
    repeated = [
        (each.identifier, name)
        for each in PRESETS
        for name, value in each.changes.items()
        if value == getattr(default, name)
    ]
    assert not repeated


def test_the_paper_has_its_own_settings():
    paper = preset("PAPER").parameters()
    assert (paper.rays, paper.alpha) == (30, 1.0)
    assert paper.cone_angle == pytest.approx(math.radians(60))
    assert (paper.sampling, paper.sight) == ("FACES", "CONE")
    assert (paper.psi_pairs, paper.containers) == ("RAYS", "HOLLOW")


def test_changes_of_ones_own_come_last():
    paper = preset("PAPER").parameters(alpha=0.5, parts=3)
    assert (paper.alpha, paper.parts, paper.sampling) == (0.5, 3, "FACES")


def test_an_unknown_preset_is_told():
    with pytest.raises(DecompositionError, match=r"no preset 'BEST'; choose from DEF"):
        preset("BEST")
