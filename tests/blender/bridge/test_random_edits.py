"""Random work on objects with parts: table, faces, groups and record stay in step.

`make stress` takes 10,000 steps, other ones each time.
"""

import os

from hypothesis import HealthCheck, Phase, settings
from hypothesis.stateful import run_state_machine_as_test
from random_work.artist import RestlessArtist

STEPS = 30
STRESS = int(os.environ.get("WCD_STRESS_STEPS", "0"))


def test_whatever_an_artist_does_all_stays_in_step(tmp_path, capfd):
    RestlessArtist.folder = tmp_path
    run_state_machine_as_test(
        RestlessArtist,
        settings=settings(
            max_examples=STRESS // STEPS if STRESS else 10,
            stateful_step_count=STEPS,
            derandomize=not STRESS,
            database=None,
            phases=[Phase.generate],  # shrinking takes minutes
            deadline=None,
            suppress_health_check=list(HealthCheck),
        ),
    )
    # Blender prints what goes wrong when a property is set, and goes on.
    printed = capfd.readouterr()
    assert "Traceback" not in printed.out + printed.err, printed.err
