# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""State files and traces make the same picture again. Argument: what to do."""
import os
import sys

import paraview.simple
from cslfparaview import *
from paraview import smstate, smtrace


def make():
    """The pipeline, by way of a file."""
    field = bake(make_scene())
    SaveData(os.path.abspath("state.mp4"), proxy=field, Preset="fast")
    view = make_view()
    paraview.simple._DisableFirstRenderCameraReset()
    look(view)
    Show(OpenDataFile(os.path.abspath("state.mp4")), view)
    Render(view)
    return view


step = sys.argv[1]
if step == "save":
    config = smtrace.start_trace(preamble="")
    view = make()
    trace = smtrace.stop_trace()
    with open("trace.py", "w") as file:
        file.write(trace)
    take_picture(view, "traced.png")
    # Traces lack a property that a script sets; states have it.
    GetDisplayProperties(view=view).Exposure = 0.5
    take_picture(view, "saved.png")
    SaveState("state.pvsm")
    with open("state.py", "w") as file:
        file.write(smstate.get_state())
else:
    if step == "pvsm":
        LoadState("state.pvsm")
    else:
        with open({"python": "state.py", "trace": "trace.py"}[step]) as file:
            exec(file.read())
    view = GetActiveView()
    if step == "trace":
        look(view)
    expected = read_picture("traced.png" if step == "trace" else "saved.png")
    check(expected.max() > 100, "the picture is empty")
    quality = psnr(take_picture(view, step + ".png"), expected)
    check(quality > 60, f"{quality} dB")
