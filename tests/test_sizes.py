"""Sizes: what a reader has to take in at once, in code, tests and tools."""

import ast

from conftest import ROOT

SHIPPED = [
    ROOT / "__init__.py",
    *(p for top in ("core", "operators", "ui") for p in (ROOT / top).rglob("*.py")),
]
ALL = SHIPPED + [
    path for top in ("tests", "docs", ".tools") for path in (ROOT / top).rglob("*.py")
]


def listed(sizes):
    return "; ".join(f"{name}: {size}" for name, size in sizes.items())


def test_folders_hold_at_most_16_entries():
    folders = {path.parent for path in ALL} - {ROOT}
    assert len(folders) > 25
    folders |= {folder.parent for folder in folders} - {ROOT}
    entries = {
        str(folder.relative_to(ROOT)): sum(
            not each.name.startswith((".", "__pycache__")) for each in folder.iterdir()
        )
        for folder in folders
    }
    crowded = {folder: number for folder, number in entries.items() if number > 16}
    assert not crowded, listed(crowded)


def test_files_have_30_to_250_lines():
    texts = {p: p.read_text(encoding="utf-8") for p in ALL}
    sizes = {path: text.count("\n") for path, text in texts.items()}
    lengths = {str(path.relative_to(ROOT)): sizes[path] for path in SHIPPED}
    long = {path.name: number for path, number in sizes.items() if number > 250}
    # A short module is part of its neighbor.
    short = {
        name: number
        for name, number in lengths.items()
        if number < 30 and not name.endswith(("__init__.py", "errors.py"))
    }
    assert not long | short, listed(long | short)


def test_functions_have_at_most_50_lines():
    functions = {
        f"{path.relative_to(ROOT)}:{node.lineno} {node.name}": node
        for path in ALL
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(node, ast.FunctionDef)
    }
    assert len(functions) > 1500
    lengths = {name: f.end_lineno - f.lineno + 1 for name, f in functions.items()}
    long = {name: number for name, number in lengths.items() if number > 50}
    assert not long, listed(long)


def test_no_two_test_modules_have_one_name():
    names = [path.name for path in (ROOT / "tests").rglob("test_*.py")]
    twice = {name for name in names if names.count(name) > 1}
    assert not twice, twice
