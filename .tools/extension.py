"""Make the extension's zips out of the checkout and the wheels its manifest lists.

Run by the Makefile; `build` needs the bpy module, whose builder it uses.
"""

from __future__ import annotations

import argparse
import re
import subprocess
import sys
import tempfile
import tomllib
import zipfile
from importlib.util import find_spec
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
MANIFEST = ROOT / "blender_manifest.toml"


def wheel_names() -> list[str]:
    """Return the file names of the wheels that the manifest lists."""
    wheels = tomllib.loads(MANIFEST.read_text(encoding="utf-8"))["wheels"]
    return [Path(wheel).name for wheel in wheels]


def requirement_of(wheel: str) -> str:
    """Return `name==version` of a wheel's file name."""
    name, version = wheel.split("-")[:2]
    return f"{name}=={version}"


def print_pins() -> None:
    """Print the requirements that the wheels make for the running Python."""
    here = f"cp{sys.version_info.major}{sys.version_info.minor}"
    tags = {here, f"py{sys.version_info.major}"}
    pins = {
        requirement_of(name) for name in wheel_names() if name.split("-")[2] in tags
    }
    print("\n".join(sorted(pins)))


def fetch() -> None:
    """Fill wheels/ with what the manifest lists, and nothing else."""
    folder = ROOT / "wheels"
    folder.mkdir(exist_ok=True)
    names = wheel_names()
    for stale in set(folder.iterdir()) - {folder / name for name in names}:
        stale.unlink()
    missing = [name for name in names if not (folder / name).exists()]
    # Wheels of the same Python and machine come by one call of pip.
    groups: dict[tuple[str, str], list[str]] = {}
    for name in missing:
        python, _abi, platform = name.removesuffix(".whl").split("-")[2:]
        machine = re.sub(r"\d+", "", platform.split(".")[0])
        groups.setdefault((python, machine), []).append(name)
    for number, group in enumerate(groups.values(), start=1):
        print(f"Fetching wheels, {number} of {len(groups)}: {', '.join(group)}")
        download(group, folder)
    for name in names:
        if not (folder / name).exists():
            sys.exit(f"{name} is not to be had; correct `wheels` in {MANIFEST.name}.")


def download(names: list[str], folder: Path) -> None:
    """Download wheels that share a Python and a kind of machine."""
    python, abi = names[0].split("-")[2:4]
    platforms = {
        tag
        for name in names
        for tag in name.removesuffix(".whl").split("-")[4].split(".")
    }
    command = [sys.executable, "-m", "pip", "download", "-qq", "--no-deps"]
    command += ["--only-binary=:all:", f"--dest={folder}", f"--abi={abi}"]
    command += [f"--platform={tag}" for tag in sorted(platforms)]
    if python.startswith("cp"):
        command += ["--implementation=cp", f"--python-version={python[2:]}"]
    command += [requirement_of(name) for name in names]
    if subprocess.run(command).returncode != 0:
        sys.exit("The wheels cannot be downloaded; see pip's message above.")


def builder_command(*arguments: str | Path) -> list[str]:
    """Return a call of the builder of extensions inside the bpy module."""
    spec = find_spec("bpy")
    if spec is None or spec.origin is None:
        sys.exit("This Python has no bpy, whose builder makes the zips.")
    scripts = next(Path(spec.origin).parent.glob("*/scripts"))
    builder = scripts / "addons_core" / "bl_pkg" / "cli" / "blender_ext.py"
    tags = scripts / "modules" / "_bpy_internal" / "extensions" / "tags.py"
    command = [sys.executable, str(builder), str(arguments[0]), f"--valid-tags={tags}"]
    return command + [str(argument) for argument in arguments[1:]]


def build(output: Path) -> None:
    """Build and validate one zip per platform, and one without wheels."""
    fetch()
    output.mkdir(parents=True, exist_ok=True)
    for old in output.glob("*.zip"):
        old.unlink()
    run_builder(
        "build", f"--source-dir={ROOT}", f"--output-dir={output}", "--split-platforms"
    )
    with tempfile.TemporaryDirectory() as folder:
        unpack_without_wheels(next(output.glob("*.zip")), Path(folder))
        version = tomllib.loads(MANIFEST.read_text(encoding="utf-8"))["version"]
        name = f"weak_convex_decomposition-{version}-no_wheels.zip"
        run_builder(
            "build", f"--source-dir={folder}", f"--output-filepath={output / name}"
        )
    for path in sorted(output.glob("*.zip")):
        run_builder("validate", path)
        print(f"{path.stat().st_size / 1e6:6.1f} MB  {path}")


def unpack_without_wheels(archive: Path, folder: Path) -> None:
    """Unpack what a Blender on the system's Python can use.

    Blender refuses an extension whose wheels are all for other Pythons, though the
    distribution may well have SciPy and scikit-learn for its own.
    """
    with zipfile.ZipFile(archive) as contents:
        names = contents.namelist()
        contents.extractall(folder, [n for n in names if not n.startswith("wheels/")])
    manifest = MANIFEST.read_text(encoding="utf-8")
    for field in ("platforms", "wheels"):
        manifest = re.sub(
            rf"^(?:#[^\n]*\n)*{field} = \[.*?\]\n\n?", "", manifest, flags=re.M | re.S
        )
    (folder / MANIFEST.name).write_text(manifest, encoding="utf-8")


def run_builder(*arguments: str | Path) -> None:
    """Run the builder, and show what it says if it fails."""
    done = subprocess.run(builder_command(*arguments), capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{done.stdout}{done.stderr}The extension cannot be built.")


def main() -> None:
    """Run one of the commands."""
    parser = argparse.ArgumentParser(description=__doc__)
    commands = parser.add_subparsers(dest="command", required=True)
    commands.add_parser("pins", help="print the requirements for this Python")
    building = commands.add_parser("build", help="make and validate the zips")
    building.add_argument("--output", type=Path, required=True)
    arguments = parser.parse_args()
    if arguments.command == "pins":
        print_pins()
    else:
        build(arguments.output.resolve())


if __name__ == "__main__":
    main()
