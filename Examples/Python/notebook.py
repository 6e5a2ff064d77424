# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Light fields in a notebook: the parts between the lines "# %%" are its cells, to editors that
know them and to Jupytext. Run as a program, it writes the pictures. Arguments: M N samples."""
# %% Sample a scene.
import cslf
from example import read_sizes, set_sizes

box = cslf.vtkCSLFCornellBoxSource()
sampler = cslf.vtkCSLFSampler()
sampler.SetInputConnection(box.GetOutputPort())
sampler.GetEnvironment().SetModeToNone()  # the box has its own lamp
set_sizes(sampler, read_sizes(__doc__))

# %% A cell that ends with a picture shows it.
picture = cslf.show(sampler, size=(480, 480))
picture  # noqa: B018

# %% From another position, with another lookup.
other = cslf.show(sampler, size=(480, 480), position=(-0.8, 0.6, 3.6), lookup="Focal")
other  # noqa: B018

# %% Pictures can be saved.
picture.save("Notebook.png")
