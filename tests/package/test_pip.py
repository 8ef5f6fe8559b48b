"""What `pip install .` gives: a package for scripts and a command."""

import re
import subprocess
import sys
import sysconfig
import tomllib
from dataclasses import dataclass
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PYTHON_BLOCK = re.compile(r"^```python\n(.*?)^```", re.M | re.S)
IMPORT = "from weak_convex_decomposition import"
WITHOUT_NETWORK = ("No matching distribution", "Could not find a version")


@dataclass(frozen=True)
class Environment:
    """A virtual environment, and a folder far from the checkout to work in."""

    scripts: Path
    folder: Path

    def run(self, program: str, *arguments: str) -> subprocess.CompletedProcess:
        return subprocess.run(
            [self.scripts / program, *arguments],
            cwd=self.folder,
            capture_output=True,
            text=True,
            timeout=600,
        )


@pytest.fixture(scope="module")
def environment(tmp_path_factory) -> Environment:
    """Return a fresh environment with the package and Embree, without bpy."""
    folder = tmp_path_factory.mktemp("pip")
    subprocess.run([sys.executable, "-m", "venv", folder / "venv"], check=True)
    paths = {"base": str(folder / "venv"), "platbase": str(folder / "venv")}
    scripts = Path(sysconfig.get_path("scripts", "venv", paths))
    made = Environment(scripts, folder)
    done = made.run("python", "-m", "pip", "install", "-q", f"{ROOT}[embree]")
    if any(sentence in done.stderr for sentence in WITHOUT_NETWORK):
        pytest.skip(f"nothing can be downloaded: {done.stderr}")
    assert done.returncode == 0, done.stderr
    return made


def readme_script() -> str:
    """Return the README's script for plain Python."""
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    (script,) = (block for block in PYTHON_BLOCK.findall(readme) if IMPORT in block)
    return script


def test_the_script_of_the_readme_runs_without_a_warning(environment):
    script = environment.folder / "script.py"
    script.write_text(readme_script(), encoding="utf-8")
    done = environment.run("python", "-W", "error", script.name)
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout


def test_installed_is_the_package_alone(environment, manifest):
    done = environment.run(
        "python",
        *("-c", "import weak_convex_decomposition as p; print(p.__path__[0])"),
    )
    assert done.returncode == 0, done.stderr
    package = Path(done.stdout.strip())
    assert package.is_relative_to(environment.folder)
    names = {path.name for path in package.iterdir()} - {"__pycache__"}
    assert names == {
        *("__init__.py", "__main__.py", "blender_manifest.toml", "py.typed"),
        *("core", "operators", "ui"),
    }
    information = next(package.parent.glob("weak_convex_decomposition-*.dist-info"))
    assert information.name == f"{package.name}-{manifest['version']}.dist-info"
    assert (information / "licenses" / "LICENSE").exists()


def test_it_requires_what_the_manifest_has_wheels_of(manifest):
    text = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    project = tomllib.loads(text)["project"]
    required = {
        re.match(r"[\w-]+", line).group().replace("-", "_")
        for line in project["dependencies"]
    }
    wheels = {Path(wheel).name.partition("-")[0] for wheel in manifest["wheels"]}
    assert required - {"numpy"} <= wheels
    assert set(project["optional-dependencies"]) == {"bpy", "embree"}


@pytest.mark.parametrize(
    "command", [["wcd"], ["python", "-m", "weak_convex_decomposition"]], ids=" ".join
)
def test_the_command_says_that_bpy_is_missing(environment, command):
    done = environment.run(*command, "--version")
    assert done.returncode == 2
    assert done.stdout == ""
    assert re.fullmatch(r"error: .* has no module bpy; install .*\n", done.stderr)
    assert "[bpy]" in done.stderr
    assert done.stderr.count("\n") == 1


def test_a_missing_ray_caster_is_told_in_a_sentence(environment):
    hide = "import sys; sys.modules['embreex.mesh_construction'] = None\n"
    done = environment.run("python", "-c", hide + readme_script())
    assert done.returncode == 1
    assert "No ray caster is installed; install Embree with" in done.stderr
