"""Every format has its reader or writer, and readers and writers stay apart."""

import pytest
from test_architecture import import_graph, reached_from
from weak_convex_decomposition.operators.headless import formats
from weak_convex_decomposition.operators.headless.read.importers import IMPORTERS

HEADLESS = "operators.headless"


def modules_in(folder, names):
    """Return the modules in a folder of the command line, of those named."""
    return {name for name in names if name.startswith(f"{HEADLESS}.{folder}.")}


def test_every_ending_has_an_importer():
    assert tuple(IMPORTERS) == formats.READ_ENDINGS


@pytest.mark.parametrize(
    ("folder", "others"),
    [
        ("read", ("write", "request", "run")),
        ("write", ("read", "request", "run")),
        ("request", ("read", "write", "run")),
        ("files", ("read", "write", "request", "run")),
    ],
)
def test_readers_writers_and_options_know_nothing_of_each_other(folder, others):
    """Nor do the modules that they import, and those that these import."""
    graph = import_graph()
    own = modules_in(folder, graph)
    assert len(own) > 3
    reached = reached_from(own, graph)
    for other in others:
        assert not modules_in(other, reached), other
