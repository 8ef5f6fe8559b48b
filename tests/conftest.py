"""What every ring shares: the package, and what a missing Blender means."""

import importlib.util
import os
import signal
import sys
from pathlib import Path

import pytest
from checkout import PACKAGE, ROOT  # noqa: F401  # tests take them from here

# Before NumPy is loaded: threads wait for each other where other programs are busy.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

# Shells let what they start in the background ignore Ctrl-C, and all that it starts.
if signal.getsignal(signal.SIGINT) == signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)

EXIT_STATUS = pytest.StashKey[int]()

HAS_BLENDER = importlib.util.find_spec("bpy") is not None
REQUIRE_BLENDER = os.environ.get("WCD_REQUIRE_BLENDER") == "1"
RINGS_WITH_BLENDER = ("blender", "package")
TESTS = Path(__file__).parent

# Their modules import bpy at the top, so without it they cannot even be collected.
collect_ignore_glob = (
    [] if HAS_BLENDER else [f"{ring}/*" for ring in RINGS_WITH_BLENDER]
)


def pytest_configure(config: pytest.Config) -> None:
    if REQUIRE_BLENDER and not HAS_BLENDER:
        raise pytest.UsageError(
            "WCD_REQUIRE_BLENDER is set, but there is no bpy to import."
        )


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    if not HAS_BLENDER:
        rings = " and ".join(f"tests/{ring}" for ring in RINGS_WITH_BLENDER)
        terminalreporter.write_line(f"SKIPPED {rings}: bpy cannot be imported.")


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Begin with the tests of the zips, which take longest."""
    items.sort(key=lambda item: ring_of(item) != "package")


def ring_of(item: pytest.Item) -> str:
    """Return the folder of tests/ that a test is in, wherever the checkout is."""
    return item.path.relative_to(TESTS).parts[0]


@pytest.hookimpl(optionalhook=True)  # where xdist is installed
def pytest_xdist_make_scheduler(config: pytest.Config, log: object) -> object:
    """Keep tests together that share what is expensive, where several processes test.

    A process takes the tests of a file, and one of them the whole of tests/package: it
    builds the zips once. Groups of xdist 3.8 do nothing in pytest 9.2, which has no
    `_nodeid` that they could be written to.
    """
    from xdist.scheduler import LoadFileScheduling

    class ByFileOrPackage(LoadFileScheduling):
        def _split_scope(self, nodeid: str) -> str:
            file = nodeid.partition("::")[0]
            return "package" if "package" in file.split("/") else file

    return ByFileOrPackage(config, log)


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(item: pytest.Item):
    """Turn skips into failures where Blender is required."""
    report = yield
    if REQUIRE_BLENDER and ring_of(item) in RINGS_WITH_BLENDER and report.skipped:
        report.outcome = "failed"
        report.longrepr = f"skipped under WCD_REQUIRE_BLENDER: {report.longrepr}"
    return report


@pytest.hookimpl(trylast=True)
def pytest_unconfigure(config: pytest.Config) -> None:
    """Leave at once where Blender would crash on the way out, after all is reported.

    The bpy 4.2 wheel does, once a glTF file was exported; `__main__` does the same.
    """
    bpy = sys.modules.get("bpy")
    status = config.stash.get(EXIT_STATUS, None)
    if bpy and bpy.app.version < (4, 3) and status is not None:
        config.get_terminal_writer().flush()
        os._exit(status)


def pytest_sessionfinish(session: pytest.Session, exitstatus: int) -> None:
    session.config.stash[EXIT_STATUS] = int(exitstatus)
