# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""State files and traces make the same picture again. Argument: what to do."""
import os
import sys

from cslfparaview import *
from paraview import smstate, smtrace


def make():
    """The pipeline, by way of a file."""
    field = bake(make_scene())
    SaveData(os.path.abspath("state.mp4"), proxy=field)
    view = make_view()
    display = Show(OpenDataFile(os.path.abspath("state.mp4")), view)
    display.Exposure = 0.5
    look(view)
    Show(field, view).Position = [0.0, 1.0, 0.0]
    return view


step = sys.argv[1]
if step == "save":
    config = smtrace.start_trace(preamble="")
    view = make()
    Render(view)
    trace = smtrace.stop_trace()
    with open("trace.py", "w") as file:
        file.write(trace)
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
    quality = psnr(take_picture(GetActiveView(), step + ".png"), read_picture("saved.png"))
    check(read_picture("saved.png").max() > 100, "the picture is empty")
    check(quality > 60, f"{quality} dB")
