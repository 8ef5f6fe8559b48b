import io
import os
import subprocess
import sys
from pathlib import Path

import pytest
from weak_convex_decomposition.core.steps.progress import Progress
from weak_convex_decomposition.operators.headless.request.option_names import (
    with_options,
)
from weak_convex_decomposition.operators.headless.screen import Screen, progress_title

CHECKOUT = Path(__file__).parents[3]


class Terminal(io.StringIO):
    def isatty(self):
        return True


def test_progress_keeps_to_one_line_on_a_terminal():
    now = iter(range(100))
    out, err = io.StringIO(), Terminal()
    screen = Screen(out, err, quiet=False, clock=lambda: next(now))
    screen.progress("a", Progress("Samples", 0.25))
    screen.progress("a", Progress("Sight", 0.5))
    screen.result("done")
    assert "\n" not in err.getvalue()
    assert err.getvalue().endswith("\ra: Sight  50%\r" + " " * 13 + "\r")
    assert out.getvalue() == "done\n"


def test_progress_is_sparse_in_a_log():
    err = io.StringIO()
    times = iter([0.0, 0.0, 0.5, 3.0, 3.0, 9.0, 9.0])
    screen = Screen(io.StringIO(), err, quiet=False, clock=lambda: next(times))
    for stage in ("Samples", "Sight", "Sight", "Sight"):
        screen.progress("a", Progress(stage, 0.5))
    assert err.getvalue() == "a: Samples (50%)\na: Sight (50%)\n"


def test_progress_says_which_object_of_many_it_is():
    assert progress_title("a, Ring", 3, 1000) == "a, Ring (object 3 of 1,000)"
    assert progress_title("a, Ring", 1, 1) == "a, Ring"


def test_what_an_encoding_lacks_is_spelled_out():
    stream = io.TextIOWrapper(io.BytesIO(), encoding="ascii", newline="\n")
    Screen(stream, stream, quiet=False).result("Käse")
    assert stream.buffer.getvalue() == b"K\\xe4se\n"


@pytest.mark.parametrize(
    ("text", "hint"),
    [
        ("Detail is 11; choose a value from 0 to 10.", " (Detail is --alpha.)"),
        ("Details are found.", ""),
        ("Detail.obj cannot be read.", ""),
        ("models/Detail/a.obj cannot be read.", ""),
        ("x Detail y.obj has no meshes.", ""),
        ("x Detail y.obj: Most Hulls is 0.", " (Most Hulls is --max-hulls.)"),
    ],
)
def test_options_are_named_for_settings_not_for_files(text, hint):
    assert with_options(text) == text + hint


def test_options_are_named_for_sentences_not_for_titles():
    err = io.StringIO()
    screen = Screen(io.StringIO(), err, quiet=True)
    screen.warning("It has no faces.", "d.blend, Detail")
    screen.error("Detail is 11.", "Most Hulls")
    assert err.getvalue() == (
        "warning: d.blend, Detail: It has no faces.\n"
        "error: Most Hulls: Detail is 11. (Detail is --alpha.)\n"
    )


def test_follow_shows_progress_and_returns_the_value():
    def steps():
        yield Progress("Sight", 0.5)
        return 7

    err = io.StringIO()
    assert Screen(io.StringIO(), err, quiet=False).follow("a", steps()) == 7
    assert err.getvalue() == "a: Sight (50%)\n"


def test_output_that_goes_nowhere_ends_the_run_without_a_traceback(tmp_path):
    (tmp_path / "a.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    full = "error: What the command prints cannot be written (No space left on device)."
    closed = (
        "error: --report is -, but standard output is closed; name a file for the"
        " report."
    )
    read, broken = os.pipe()
    os.close(read)
    # Set by bpy in this process, and what could keep the text of --version unbuffered.
    unset = ("OCIO", "PYTHONUNBUFFERED")
    cases = [
        ("a.obj --samples 20", "", 1, ""),
        ("--version", "", 1, ""),
        ("a.obj --samples 20", ">/dev/full", 1, full),
        ("a.obj --samples 20", ">&-", 0, ""),
        ("a.obj --samples 20 --report -", ">&-", 1, closed),
        ("a.obj --samples 20", "2>&- >/dev/full", 1, ""),
    ]
    for arguments, redirection, status, message in cases:
        command = f'"$0" "$1" {arguments} {redirection}'
        done = subprocess.run(
            ["sh", "-c", command, sys.executable, CHECKOUT],
            cwd=tmp_path,
            env={k: v for k, v in os.environ.items() if k not in unset},
            stdout=broken,
            stderr=subprocess.PIPE,
            text=True,
            check=False,
            timeout=100,
        )
        case = (arguments, redirection, done.stderr)
        assert done.returncode == status, case
        assert [line for line in done.stderr.splitlines() if "rror" in line] == (
            [message] if message else []
        ), case
    os.close(broken)
