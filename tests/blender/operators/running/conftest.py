"""A stand-in for the window, and slices of one step."""

from contextlib import nullcontext
from types import SimpleNamespace

import pytest
from stand_ins.presses import Window
from weak_convex_decomposition.operators.running import modal


@pytest.fixture
def window(monkeypatch):
    window = Window()
    context = SimpleNamespace(
        window=None,
        window_manager=window,
        temp_override=lambda workspace: nullcontext(),
    )
    data = SimpleNamespace(workspaces={"Layout": window})
    monkeypatch.setattr(modal, "bpy", SimpleNamespace(context=context, data=data))
    # One step at each event, however fast the machine is.
    monkeypatch.setattr(modal, "_SLICE", 0.0)
    yield window
    modal.stop()
