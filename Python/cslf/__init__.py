# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Cube surface light fields for VTK: sample, encode, decode and render them.

The classes work beside those of ``vtkmodules``::

    from cslf import vtkCSLFSampler

In a notebook, ``cslf.show(field)`` is a picture of a light field. ``import cslf.pyvista`` adds
``plotter.cslf`` to PyVista's plotters.
"""

import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  the mapper draws with OpenGL

from .vtkCSLF import *  # noqa: F401,F403
from .fields import make_actor  # noqa: F401
from .notebook import Picture, capture, show  # noqa: F401
