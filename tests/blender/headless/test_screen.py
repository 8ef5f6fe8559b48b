import io

from weak_convex_decomposition.core.steps.progress import Progress
from weak_convex_decomposition.operators.headless.screen import Screen


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


def test_what_an_encoding_lacks_is_spelled_out():
    stream = io.TextIOWrapper(io.BytesIO(), encoding="ascii", newline="\n")
    Screen(stream, stream, quiet=False).result("Käse")
    assert stream.buffer.getvalue() == b"K\\xe4se\n"


def test_follow_shows_progress_and_returns_the_value():
    def steps():
        yield Progress("Sight", 0.5)
        return 7

    err = io.StringIO()
    assert Screen(io.StringIO(), err, quiet=False).follow("a", steps()) == 7
    assert err.getvalue() == "a: Sight (50%)\n"
