"""The zip in a fresh profile of a Blender that has no SciPy of its own."""

import json
import platform
import re
import sys
from pathlib import Path

import pytest

SCRIPTS = Path(__file__).parent / "scripts"
ZIP_HERE = {
    ("linux", "x86_64"): "linux_x64",
    ("win32", "AMD64"): "windows_x64",
    ("darwin", "arm64"): "macos_arm64",
}


@pytest.fixture(scope="module")
def seen(zips, bare_blender, tmp_path_factory) -> dict:
    """Return what the script saw, from installing to decomposing."""
    end = ZIP_HERE.get((sys.platform, platform.machine()))
    if end is None:
        pytest.skip(f"no zip for {sys.platform} on {platform.machine()}")
    return install_and_decompose(
        bare_blender, zips[end], tmp_path_factory.mktemp("seen")
    )


def install_and_decompose(blender, zip_path, folder) -> dict:
    path = folder / "seen.json"
    done = blender.run(SCRIPTS / "install_and_decompose.py", zip_path, path)
    assert done.returncode == 0, done.stdout + done.stderr
    return json.loads(path.read_text(encoding="utf-8"))


def test_installs_and_enables(seen):
    assert seen["installed"] == ["FINISHED"]
    assert seen["enabled"]


def test_enabling_imports_neither_scipy_nor_sklearn(seen):
    assert seen["loaded_by_enabling"] == []


@pytest.mark.parametrize("module", ["scipy", "sklearn"])
def test_the_bundled_wheels_are_used(seen, module, bare_blender, manifest):
    file, version = seen[module]
    assert Path(file).is_relative_to(bare_blender.profile)
    distribution = {"scipy": "scipy", "sklearn": "scikit_learn"}[module]
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    expected = f"./wheels/{distribution}-{version}-{python}-"
    assert any(wheel.startswith(expected) for wheel in manifest["wheels"])


def test_decomposes_suzanne(seen):
    assert seen["finished"] == ["FINISHED"]
    n_parts = len(set(seen["labels"]))
    assert n_parts >= 2
    assert len(seen["labels"]) == seen["faces"]
    assert len(seen["groups"]) == n_parts
    assert all(re.fullmatch(r"Part \d\d(\.[LR])?", name) for name in seen["groups"])


def test_another_process_finds_the_package_and_the_wheels(seen):
    assert seen["answered"] == [True]
    assert seen["hulls"] == 4


@pytest.mark.usefixtures("seen")
def test_enabling_prints_nothing(bare_blender):
    done = bare_blender.run(SCRIPTS / "enable.py")
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")


def test_without_wheels_the_scipy_of_the_system_is_used(
    zips, blender_with_scipy, tmp_path
):
    seen = install_and_decompose(blender_with_scipy, zips["no_wheels"], tmp_path)
    assert seen["finished"] == ["FINISHED"]
    assert not Path(seen["scipy"][0]).is_relative_to(blender_with_scipy.profile)
