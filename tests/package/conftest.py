"""The zips, and a Blender that has nothing but what Blender ships."""

import re
import subprocess
import sys
import sysconfig
import tomllib
from dataclasses import dataclass
from importlib import metadata
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
EXTENSION_TOOL = ROOT / ".tools" / "extension.py"


@pytest.fixture(scope="session")
def manifest() -> dict:
    return tomllib.loads((ROOT / "blender_manifest.toml").read_text(encoding="utf-8"))


@pytest.fixture(scope="session")
def zips(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """Return the zips by what ends their name: linux_x64, …, no_wheels."""
    output = tmp_path_factory.mktemp("zips")
    done = subprocess.run(
        [sys.executable, EXTENSION_TOOL, "build", "--output", output],
        capture_output=True,
        text=True,
    )
    if "cannot be downloaded" in done.stderr:
        pytest.skip(f"no wheels, no zips: {done.stderr}")
    assert done.returncode == 0, done.stdout + done.stderr
    return {path.stem.rpartition("-")[2]: path for path in output.glob("*.zip")}


@dataclass(frozen=True)
class Blender:
    """A Python with bpy, and a profile that nobody else uses."""

    python: Path
    profile: Path

    def run(self, script: Path, *arguments: str | Path) -> subprocess.CompletedProcess:
        return subprocess.run(
            [self.python, "-I", script, *arguments],
            capture_output=True,
            text=True,
            timeout=600,
            env={"BLENDER_USER_RESOURCES": str(self.profile), "PATH": ""},
        )


@pytest.fixture(scope="session")
def bare_blender(tmp_path_factory: pytest.TempPathFactory) -> Blender:
    """Return a Blender to which the SciPy of this environment is invisible."""
    environment = tmp_path_factory.mktemp("bare")
    subprocess.run(
        [sys.executable, "-m", "venv", "--without-pip", environment], check=True
    )
    paths = {"base": str(environment), "platbase": str(environment)}
    site_packages = Path(sysconfig.get_path("purelib", "venv", paths))
    for distribution in _with_requirements("bpy"):
        for entry in {file.parts[0] for file in distribution.files} - {".."}:
            source = distribution.locate_file(entry)
            link = site_packages / entry
            if source.exists() and not link.exists():
                link.symlink_to(source)
    python = environment / Path(sys.executable).relative_to(sys.prefix)
    return Blender(python, tmp_path_factory.mktemp("profile"))


@pytest.fixture(scope="session")
def blender_with_scipy(tmp_path_factory: pytest.TempPathFactory) -> Blender:
    """Return a Blender like a distribution's: its Python has SciPy already."""
    return Blender(Path(sys.executable), tmp_path_factory.mktemp("profile"))


def _with_requirements(name: str) -> list[metadata.Distribution]:
    """Return an installed distribution and all that it requires, without extras."""
    found: dict[str, metadata.Distribution] = {}
    names = [name]
    while names:
        name = names.pop()
        if name in found:
            continue
        found[name] = metadata.distribution(name)
        for requirement in found[name].requires or ():
            if ";" not in requirement:
                names.append(re.match(r"[\w.-]+", requirement).group())
    return list(found.values())
