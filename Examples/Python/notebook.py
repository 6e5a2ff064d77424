# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Light fields in a notebook: the parts between the lines "# %%" are its cells, to editors that
know them and to Jupytext. Run as a program, it writes the pictures. Arguments: M N samples."""
# %% Bake a scene. Below the cell, a bar shows the progress; the button "interrupt" ends it.
import cslf
from example import read_sizes

sizes = read_sizes(__doc__)
field = cslf.bake("cornell-box", viewpoints=sizes.M, resolution=sizes.N, samples=sizes.samples)

# %% A cell that ends with a light field or with a picture shows it.
picture = field.show(size=(480, 480))
picture  # noqa: B018

# %% From another position, with another lookup.
other = field.show(size=(480, 480), position=(-0.8, 0.6, 3.6), lookup="Focal")
other  # noqa: B018

# %% Pictures can be saved.
picture.save("Notebook.png")
