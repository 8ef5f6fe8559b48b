"""The border between the core and Blender, and what enabling the add-on loads."""

import ast
import subprocess
import sys
from pathlib import Path

import pytest
from conftest import HAS_BLENDER, PACKAGE, ROOT

BLENDER_MODULES = {"bpy", "bmesh", "gpu", "mathutils"}
SLOW_MODULES = {"scipy", "sklearn"}
CORE = sorted((ROOT / "core").glob("*.py"))
SHIPPED = [
    ROOT / "__init__.py",
    *(f for d in ("core", "operators", "ui") for f in sorted((ROOT / d).rglob("*.py"))),
]


def imports(path):
    """Yield (module, level) for each import anywhere in a file."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from ((alias.name, 0) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            yield node.module or "", node.level


def run_python(code):
    """Run code in a Python of its own that knows the package.

    Returns the words of the code's last line of output; Blender prints others.
    """
    prelude = f"import sys; sys.path.insert(0, {str(Path(__file__).parent)!r})\n"
    # Blender 4.2's wheel crashes where Python ends after an add-on was registered.
    end = "import os; sys.stdout.flush(); os._exit(0)"
    done = subprocess.run(
        [sys.executable, "-c", f"{prelude}import conftest\n{code}\n{end}"],
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout.rstrip("\n").rpartition("\n")[2].split()


@pytest.mark.parametrize("path", CORE, ids=lambda path: path.name)
def test_core_names_nothing_of_blender(path):
    for module, level in imports(path):
        assert module.partition(".")[0] not in BLENDER_MODULES
        assert level <= 1, f"core reaches out of core for {module}"


@pytest.mark.parametrize("path", SHIPPED, ids=lambda p: str(p.relative_to(ROOT)))
def test_the_package_imports_itself_relatively(path):
    for module, level in imports(path):
        assert level or not module.startswith((PACKAGE, "core", "operators", "ui"))


def test_scikit_learn_is_imported_in_one_place():
    users = [p.name for p in CORE for m, _ in imports(p) if m.startswith("sklearn")]
    assert set(users) <= {"clustering.py"}


def test_the_panels_know_operators_by_name_only():
    for path in sorted((ROOT / "ui").glob("*.py")):
        assert all("operators" not in module for module, _ in imports(path))


def test_every_core_module_loads_without_blender():
    names = [f"{PACKAGE}.core.{path.stem}" for path in CORE if path.stem != "__init__"]
    loaded = run_python(
        f"import importlib\nfor name in {names!r}: importlib.import_module(name)\n"
        "print(*{name.partition('.')[0] for name in sys.modules})"
    )
    assert "numpy" in loaded
    assert not BLENDER_MODULES & set(loaded)


@pytest.mark.skipif(not HAS_BLENDER, reason="bpy cannot be imported")
def test_enabling_loads_neither_scipy_nor_scikit_learn():
    loaded = run_python(
        f"import bpy, {PACKAGE} as package\npackage.register()\n"
        "loaded = {name.partition('.')[0] for name in sys.modules}\n"
        "print(*loaded)"
    )
    assert "bpy" in loaded
    assert not SLOW_MODULES & set(loaded)


@pytest.mark.skipif(not HAS_BLENDER, reason="bpy cannot be imported")
def test_every_parameter_reaches_the_operator_and_the_settings():
    missing = run_python(
        f"import bpy, {PACKAGE} as package\npackage.register()\n"
        "from dataclasses import fields\n"
        f"from {PACKAGE}.core.parameters import Parameters\n"
        "names = {field.name for field in fields(Parameters)}\n"
        "operator = bpy.ops.wcd.decompose.get_rna_type().properties.keys()\n"
        "settings = bpy.context.scene.wcd.bl_rna.properties.keys()\n"
        "missing = (names - set(operator)) | (names - set(settings))\n"
        "package.unregister()\n"
        "print('missing:', *missing)"
    )
    assert missing == ["missing:"]
