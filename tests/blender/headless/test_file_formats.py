"""Every format has its reader or writer, and readers and writers stay apart."""

import ast
from pathlib import Path

import weak_convex_decomposition as package
from weak_convex_decomposition.operators.headless import formats
from weak_convex_decomposition.operators.headless.read.importers import IMPORTERS

HEADLESS = Path(package.__file__).parent / "operators" / "headless"
# The folders that a file of each folder may not import from.
FORBIDDEN = {
    "read": {"write", "request"},
    "write": {"read", "request"},
    "request": {"read", "write"},
}


def folders_imported_from(path):
    """Return the folders of the command line that a file below one imports from."""
    return {
        (node.module or "").partition(".")[0]
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(node, ast.ImportFrom) and node.level == 2
    }


def test_every_ending_has_an_importer():
    assert tuple(IMPORTERS) == formats.READ_ENDINGS


def test_readers_writers_and_options_do_not_import_each_other():
    for folder, forbidden in FORBIDDEN.items():
        files = sorted((HEADLESS / folder).glob("*.py"))
        assert len(files) > 3
        for file in files:
            assert not folders_imported_from(file) & forbidden, file
