# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""State files and traces make the same picture again. Argument: what to do."""
import os
import sys

import paraview.simple
from cslfparaview import *
from paraview import smstate, smtrace


def set_as_panel(proxy, **properties):
    """Sets properties as their panel does, so that traces have them."""
    item = smtrace.PropertiesModified(proxy.SMProxy)
    for name, value in properties.items():
        setattr(proxy, name, value)
    item.finalize()


def make():
    """The pipeline, by way of a file."""
    field = bake(make_scene())
    set_as_panel(field, EnvironmentMode="Gradient", EnvironmentUp=[0.0, 0.0, 1.0])
    SaveData(os.path.abspath("state.mp4"), proxy=field, Preset="fast")
    view = make_view()
    paraview.simple._DisableFirstRenderCameraReset()
    look(view)
    display = Show(OpenDataFile(os.path.abspath("state.mp4")), view)
    set_as_panel(display, Exposure=0.5, LookupMode="Bilinear")
    Render(view)
    return view


step = sys.argv[1]
if step == "save":
    smtrace.start_trace(preamble="")
    view = make()
    with open("trace.py", "w") as file:
        file.write(smtrace.stop_trace())
    take_picture(view, "saved.png")
    SaveState("state.pvsm")
    with open("state.py", "w") as file:
        file.write(smstate.get_state())
else:
    saved = os.path.getmtime("state.mp4")
    if step == "pvsm":
        LoadState("state.pvsm")
    else:
        with open({"python": "state.py", "trace": "trace.py"}[step]) as file:
            exec(file.read())
    view = GetActiveView()
    if step == "trace":
        check(os.path.getmtime("state.mp4") > saved, "the file was not written once more")
        look(view)
    expected = read_picture("saved.png")
    check(expected.max() > 100, "the picture is empty")
    quality = psnr(take_picture(view, step + ".png"), expected)
    check(quality > 60, f"{quality} dB")
