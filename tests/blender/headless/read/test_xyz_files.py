"""Point clouds in files: in, out and pictures."""

import bpy
import clouds
import numpy as np
import pytest
import shapes
from headless.command import run_wcd
from headless.loading import load
from weak_convex_decomposition.operators.bridge.mesh.points import (
    normals_of,
    positions_of,
)
from weak_convex_decomposition.operators.headless.write import picture as pictures

POINTS, NORMALS = clouds.drawn(shapes.dumbbell(), 600)
FAST = ["--samples", "150", "--parts", "2", "--containers", "HOLLOW"]
TABLE = np.c_[POINTS, NORMALS]


def rows(table):
    return "".join(" ".join(f"{value:.6f}" for value in row) + "\n" for row in table)


def ply(table, kind="ascii", columns=("x", "y", "z", "nx", "ny", "nz")):
    head = f"ply\nformat {kind} 1.0\nelement vertex {len(table)}\n"
    head += "".join(f"property float {name}\n" for name in columns) + "end_header\n"
    if kind == "ascii":
        return (head + rows(table)).encode()
    order = {"binary_little_endian": "<f4", "binary_big_endian": ">f4"}[kind]
    return head.encode() + table.astype(order).tobytes()


# Ends of lines in Latin-1 are none in UTF-8, and words in comments mean nothing.
COMMENTS = "comment Åelement more 9\ncomment end_header\nelement"
WITH_NORMALS = {
    "a.xyz": rows(TABLE).encode(),
    "comma.xyz": rows(TABLE).replace(" ", ", ").encode(),
    "a.pts": f"600\n{rows(TABLE)}".encode(),
    "rows.pwn": f"600\n{rows(TABLE)}".encode(),
    "blocks.pwn": f"600\n{rows(POINTS)}{rows(NORMALS)}".encode(),
    "comment.xyz": f"# a scan\n{rows(TABLE)}\n\n".encode(),
    "marked.xyz": f"\ufeff{rows(TABLE)}".encode(),
    "old_mac.pts": f"\n600\n{rows(TABLE)}".replace("\n", "\r").encode(),
    "ascii.ply": ply(TABLE),
    "comments.ply": ply(TABLE).replace(b"element", COMMENTS.encode(), 1),
    "little.ply": ply(TABLE, "binary_little_endian"),
    "big.ply": ply(TABLE, "binary_big_endian"),
}


def test_points_and_normals_come_in(tmp_path):
    for name, content in WITH_NORMALS.items():
        path = tmp_path / name
        path.write_bytes(content)
        (obj,) = load(path, "Z")
        assert positions_of(obj) == pytest.approx(POINTS, abs=1e-5), name
        assert normals_of(obj) == pytest.approx(NORMALS, abs=1e-5), name


def test_other_columns_are_no_normals(tmp_path):
    path = tmp_path / "a.xyz"
    for extra in (0, 1, 4):
        path.write_text(rows(np.c_[POINTS, np.ones((600, extra))]))
        (obj,) = load(path, "Z")
        assert positions_of(obj) == pytest.approx(POINTS, abs=1e-5), extra
        assert normals_of(obj) is None, extra
    colors = np.random.default_rng(0).integers(0, 256, (600, 3))
    for values in (colors, colors / 255):
        path.write_text(rows(np.c_[POINTS, values]))
        assert normals_of(load(path, "Z")[0]) is None
    path.write_text(rows(np.c_[POINTS, np.abs(NORMALS)]))
    assert normals_of(load(path, "Z")[0]) == pytest.approx(np.abs(NORMALS), abs=1e-5)
    along_axes = np.eye(3)[np.arange(600) % 3]
    path.write_text(rows(np.c_[POINTS, along_axes]))
    assert normals_of(load(path, "Z")[0]) == pytest.approx(along_axes)


def headed(text, header, to):
    """Return a .ply file with something else in its header."""
    return ply(TABLE, text).replace(header, to, 1)


BAD_FILES = {
    "empty.xyz": (b"", "is empty"),
    "words.xyz": (b"1 2 3\n1 2 three\n", "does not have numbers"),
    "ragged.xyz": (b"1 2 3\n1 2\n", "does not have numbers"),
    "two.xyz": (b"1 2\n3 4\n", "three coordinates"),
    "nan.xyz": (b"1 2 3\n1 nan 3\n", "not finite"),
    "commas.xyz": (b"1 2 3\n+1,5 -2,5e-1 3,5\n", "has commas in its numbers"),
    "counted.pts": (b"2\n1,5 2,5 3,5\n2,5 3,5 4,5\n", "has commas in its numbers"),
    "squared.xyz": ("²\n1 2 3\n".encode("latin-1"), "does not have numbers"),
    "digits.xyz": (b"9" * 5000 + b"\n1 2 3\n", "does not have numbers"),
    "large.xyz": (b"1 2 3\n1 1e39 3\n", "not finite"),
    "short.pts": (b"9\n1 2 3\n", "promises 9 points"),
    "blank.xyz": (b"\n\n", "has no points"),
    "many.pwn": (f"600\n{rows(TABLE)}{rows(TABLE[:9])}".encode(), "promises 600"),
    "few.pwn": (f"600\n{rows(POINTS)}{rows(NORMALS[:-1])}".encode(), "promises 600"),
    "cut.ply": (ply(TABLE, "binary_little_endian")[:-100], "truncated"),
    "lines.ply": (ply(TABLE)[:-3000], "truncated"),
    "words.ply": (ply(TABLE)[:-30], "truncated"),
    "more.ply": (headed("ascii", b"vertex 600", b"vertex 99999999999"), "truncated"),
    "letters.ply": (ply(TABLE) + b"1 2 three 4 5 6\n", "words where numbers"),
    "format.ply": (headed("ascii", b"ascii", b"nonsense"), "header is not one"),
    "type.ply": (headed("ascii", b"float x", b"real x"), "header is not one"),
    "grouped.ply": (headed("ascii", b"600", b"6_00"), "header is not one"),
    "negative.ply": (headed("ascii", b"vertex 6", b"vertex -6"), "header is not one"),
    "endless.ply": (headed("ascii", b"end_header", b""), "header is not one"),
    "places.ply": (headed("ascii", b"float x", b"float u"), "x, y and z, which"),
}


def test_bad_files_have_their_sentence_and_leave_the_output(
    tmp_path, unexpected, capsys
):
    assert unexpected(BAD_FILES) == {}
    output = tmp_path / "out.ply"
    output.write_text("mine")
    for name in BAD_FILES:
        words = [str(tmp_path / name), "--output", str(output), *FAST]
        assert run_wcd(*words) == 1, name
        assert "Traceback" not in capsys.readouterr().err, name
        assert output.read_text() == "mine", name


BAD_POINTS = {
    "one point": (TABLE[:1], "too few points"),
    "coincident": (np.ones((50, 3)), "at one place"),
    "collinear": (POINTS * (1, 0, 0), "in a line"),
    "zero normals": (np.c_[POINTS, 0 * NORMALS], "zero or not finite"),
    "NaN normals": (np.c_[POINTS, np.nan * NORMALS], "zero or not finite"),
}


@pytest.mark.parametrize("ending", [".xyz", ".ply"])
def test_bad_points_fail_on_the_command_line(tmp_path, ending, capsys):
    path, output = tmp_path / f"a{ending}", tmp_path / "out.ply"
    output.write_text("mine")
    for case, (table, match) in BAD_POINTS.items():
        columns = ("x", "y", "z", "nx", "ny", "nz")[: table.shape[1]]
        xyz = ending == ".xyz"
        path.write_bytes(rows(table).encode() if xyz else ply(table, columns=columns))
        assert run_wcd(path, "--output", output, *FAST) == 1, case
        said = capsys.readouterr().err
        assert match in said, case
        assert "Traceback" not in said, case
        assert output.read_text() == "mine", case


def test_points_keep_their_axes(tmp_path):
    for ending in (".xyz", ".pwn", ".pts"):
        path, output = tmp_path / f"a{ending}", tmp_path / f"{ending[1:]}.obj"
        path.write_text(rows(TABLE))
        assert run_wcd(path, "--output", output, *FAST) == 0
        lines = output.read_text().splitlines()
        written = [line.split()[1:4] for line in lines if line.startswith("v ")]
        assert np.array(written, float) == pytest.approx(POINTS, abs=1e-5), ending


def test_parts_of_points_go_out(tmp_path, monkeypatch):
    monkeypatch.setattr(pictures, "SIZE", 160)
    path = tmp_path / "a.xyz"
    path.write_text(rows(TABLE))
    output, picture = tmp_path / "out.ply", tmp_path / "out.png"
    arguments = [str(path), "--output", str(output), "--picture", str(picture), *FAST]
    assert run_wcd(*arguments) == 0
    assert picture.stat().st_size > 1000
    assert not [m for m in bpy.data.materials if m.name.startswith("Part 0")]
    (obj,) = load(output)
    assert len(obj.data.vertices) == 600
    parts = np.empty(600, dtype=np.float32)
    obj.data.attributes["part"].data.foreach_get("value", parts)
    assert set(parts) == {0, 1}
    colors = np.empty(2400, dtype=np.float32)
    obj.data.color_attributes[0].data.foreach_get("color", colors)
    assert len(np.unique(colors.reshape(-1, 4), axis=0)) == 2
