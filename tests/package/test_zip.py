"""What `make zip` packs: all that artists need, and nothing else."""

import re
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PLATFORM_WHEELS = {
    "linux_x64": "manylinux",
    "windows_x64": "win_amd64",
    "macos_arm64": "macosx",
}
SOURCE = {"__init__.py", "LICENSE", "blender_manifest.toml", "core", "operators", "ui"}


def names_in(path: Path) -> list[str]:
    with zipfile.ZipFile(path) as archive:
        return archive.namelist()


def test_there_is_a_zip_per_platform_and_one_without_wheels(zips, manifest):
    assert set(zips) == {*PLATFORM_WHEELS, "no_wheels"}
    version = manifest["version"]
    for end, path in zips.items():
        assert path.name == f"weak_convex_decomposition-{version}-{end}.zip"


@pytest.mark.parametrize("end", PLATFORM_WHEELS)
def test_top_level_of_a_platform(zips, end):
    assert {name.split("/")[0] for name in names_in(zips[end])} == SOURCE | {"wheels"}


def test_top_level_without_wheels(zips):
    assert {name.split("/")[0] for name in names_in(zips["no_wheels"])} == SOURCE


def test_only_python_below_the_top_level(zips):
    for path in zips.values():
        below = [n for n in names_in(path) if "/" in n and not n.startswith("wheels/")]
        assert [name for name in below if not name.endswith(".py")] == []
        assert [name for name in below if "test" in name or "__pycache__" in name] == []


@pytest.mark.parametrize("end", PLATFORM_WHEELS)
@pytest.mark.parametrize("python", ["cp311", "cp313"])
def test_each_platform_has_wheels_for_both_pythons(zips, end, python):
    wheels = [n for n in names_in(zips[end]) if f"-{python}-" in n]
    assert sorted(n.split("/")[1].split("-")[0] for n in wheels) == [
        "scikit_learn",
        "scipy",
    ]
    assert all(PLATFORM_WHEELS[end] in name for name in wheels)


@pytest.mark.parametrize("end", PLATFORM_WHEELS)
def test_wheels_hold_all_that_they_require_but_numpy(zips, end):
    present, required = set(), {"scipy", "scikit-learn"}
    with zipfile.ZipFile(zips[end]) as archive:
        for name in archive.namelist():
            if not name.endswith(".whl"):
                continue
            with archive.open(name) as file, zipfile.ZipFile(file) as wheel:
                inside = next(
                    n for n in wheel.namelist() if n.endswith(".dist-info/METADATA")
                )
                text = wheel.read(inside).decode().split("\n\n")[0]
            present.add(re.search(r"^Name: (\S+)", text, re.M).group(1).lower())
            required |= {
                requirement.lower()
                for requirement in re.findall(
                    r"^Requires-Dist: ([\w.-]+)[^;\n]*$", text, re.M
                )
            }
    assert present == required - {"numpy"}


def test_manifest_without_wheels_names_no_platform_and_no_wheel(zips):
    with zipfile.ZipFile(zips["no_wheels"]) as archive:
        text = archive.read("blender_manifest.toml").decode()
    assert "wheels/" not in text.split("[build]")[0]
    assert "platforms" not in text


def test_license_is_the_whole_gpl():
    text = (ROOT / "LICENSE").read_text(encoding="utf-8")
    assert "GNU GENERAL PUBLIC LICENSE" in text
    assert "Version 3, 29 June 2007" in text
    assert "END OF TERMS AND CONDITIONS" in text


def test_changelog_knows_the_version(manifest):
    assert manifest["version"] in (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")


def test_oldest_blender_is_the_one_that_is_tested(manifest):
    oldest = manifest["blender_version_min"]
    pins = ROOT / ".tools" / "requirements" / "blender4.2-python3.11.txt"
    assert f"bpy=={oldest}\n" in pins.read_text(encoding="utf-8")
