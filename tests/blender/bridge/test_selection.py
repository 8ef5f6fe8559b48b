"""Faces and edges selected in Object Mode, also on meshes that come from a file."""

import bpy
import numpy as np
import pytest
from weak_convex_decomposition.operators.bridge.mesh.selection import (
    select_edges,
    select_faces,
)


@pytest.fixture
def loaded(tmp_path):
    """Two triangles that a script made, all selected, saved and loaded."""
    mesh = bpy.data.meshes.new("Sheet")
    corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
    mesh.from_pydata(corners, [], [(0, 1, 2), (0, 2, 3)])
    bpy.context.collection.objects.link(bpy.data.objects.new("Sheet", mesh))
    path = str(tmp_path / "sheet.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.open_mainfile(filepath=path)
    return bpy.data.objects["Sheet"]


def selected(elements):
    return [element.index for element in elements if element.select]


def test_faces_of_a_loaded_mesh_are_selected_with_their_edges(loaded):
    select_faces(loaded, np.array([True, False]), extend=False)
    mesh = loaded.data
    assert selected(mesh.polygons) == [0]
    assert selected(mesh.vertices) == [0, 1, 2]
    assert len(selected(mesh.edges)) == 3
    select_faces(loaded, np.array([False, True]), extend=True)
    assert len(selected(mesh.edges)) == 5


def test_edges_of_a_loaded_mesh_are_selected_without_faces(loaded):
    select_edges(loaded, np.arange(5) == 2, extend=False)
    assert selected(loaded.data.edges) == [2]
    assert selected(loaded.data.polygons) == []


def test_hidden_faces_and_edges_stay_unselected(loaded):
    mesh = loaded.data
    mesh.polygons[0].hide = True
    outer = next(each for each in mesh.edges if set(each.vertices) == {0, 1})
    outer.hide = mesh.vertices[1].hide = True
    select_faces(loaded, np.array([True, True]), extend=False)
    assert selected(mesh.polygons) == [1]
    assert selected(mesh.vertices) == [0, 2, 3]
    select_edges(loaded, np.ones(5, dtype=bool), extend=False)
    assert selected(mesh.edges) == [each.index for each in mesh.edges if each != outer]


@pytest.mark.parametrize("hidden", [False, True])
def test_the_active_attribute_stays(loaded, hidden):
    mesh = loaded.data
    mesh.polygons[0].hide = hidden
    mesh.attributes.new("before", "FLOAT", "FACE")
    mesh.attributes.active = mesh.attributes.new("mine", "FLOAT", "FACE")
    select_faces(loaded, np.array([True, False]), extend=False)
    select_edges(loaded, np.arange(5) == 2, extend=True)
    assert mesh.attributes.active.name == "mine"
