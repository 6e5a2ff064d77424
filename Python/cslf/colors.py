# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The colours in which the scalars of a field are shown, and the bar that tells what they mean."""

import json
import math

from vtkmodules.vtkCommonCore import vtkLookupTable, vtkScalarsToColors
from vtkmodules.vtkRenderingAnnotation import vtkScalarBarActor
from vtkmodules.vtkRenderingCore import vtkTextRenderer

from . import vtkCSLF
from .arguments import check_kind, get_numbers

UNNAMED = "Scalars"  # an array without name
TABLE_SIZE = 256  # of tables made of matplotlib's maps
LABELS = 5
DOTS_PER_INCH = 72  # of text in render windows


class Scalars:
    """An array of a field's geometry, with the colour map with which it was sampled, if it had
    one."""

    def __init__(self, text, *, is_other=False):
        """``text`` is JSON as in the geometry's field data. Others gave the field no colours."""
        description = json.loads(text)
        self.array = description["array"]
        self.component = description.get("component", "")  # empty if there is only one
        self.is_other = is_other
        self.range = tuple(description["range"])
        self.is_logarithmic = description.get("logarithmic", False)

    @property
    def label(self):
        """The name as it is written in arguments: ``velocity:magnitude``."""
        array = self.array or UNNAMED
        component = "magnitude" if self.component == "Magnitude" else self.component
        return f"{array}:{component}" if component else array

    def find_name(self, text):
        """The name by which a mapper selects the array that is meant, or None."""
        array = self.array or UNNAMED
        if text == array:
            return f"{array} {self.component}" if self.is_other and self.component else array
        name, _, component = text.rpartition(":")
        number = {"x": "0", "y": "1", "z": "2"}.get(component, component)
        is_meant = text == self.label or (name, number) == (array, self.component)
        return f"{array} {self.component}" if is_meant else None


def list_scalars(mapper):
    """The scalars of the geometry that a mapper has read."""
    geometry = mapper.GetGeometry()
    if geometry is None:
        return []
    maps = list_texts(geometry, "CSLF:ColorMaps")
    known = [Scalars(text) for text in maps if "array" in json.loads(text)]
    for name in list_texts(geometry, "CSLF:Arrays") if maps else []:
        array = geometry.GetPointData().GetArray(name)
        known += describe_array(array) if array else []
    return known


def has_no_map(mapper):
    """Whether the geometry has scalars, but no colour map of its own."""
    known = list_scalars(mapper)
    return bool(known) and all(scalars.is_other for scalars in known)


def list_texts(geometry, name):
    """The texts of an array of field data, none without it."""
    texts = geometry.GetFieldData().GetAbstractArray(name)
    return [texts.GetValue(i) for i in range(texts.GetNumberOfValues())] if texts else []


def describe_array(array):
    """The magnitude and the components of an array that gave a field no colours."""
    count = array.GetNumberOfComponents()
    names = [array.GetComponentName(i) or str(i) for i in range(count)]
    parts = [(-1, "Magnitude"), *enumerate(names)] if count > 1 else [(0, "")]
    return [Scalars(json.dumps({"array": array.GetName(), "component": component,
                                "range": array.GetFiniteRange(number)}), is_other=True)
            for number, component in parts]


def require_scalars(mapper, parameter):
    """The scalars of a mapper's field. Raises ValueError if they cannot be shown in other
    colours."""
    if mapper.GetLookup() != mapper.GEOMETRY:
        raise ValueError(f"{parameter} needs the lookup Geometry.")
    known = list_scalars(mapper)
    if not known:
        raise ValueError(f"{parameter} needs a field with scalars, as those of scenes with a colour "
                         "map have; this one has none.")
    return known


def choose_scalars(mapper, name):
    """Lets a mapper select an array, or keeps all if the name is None. Returns the first that is
    selected."""
    known = require_scalars(mapper, "scalars" if name is not None else "cmap or clim")
    if name is None:
        return known[0]
    check_kind(name, str, "scalars", "the name of an array")
    for each in known:
        selected = each.find_name(name)
        if selected is not None:
            mapper.SelectColorArray(selected)
            return each
    labels = ", ".join(sorted({each.label for each in known}))
    raise ValueError(f"scalars must be one of the field's arrays, {labels}; it is {name!r}.")


def list_maps():
    """The names of our colour maps; none in builds without the sampler."""
    look = getattr(vtkCSLF, "vtkCSLFSceneLook", None)
    if look is None:
        return []
    return [look.GetColorMapName(i) for i in range(1, look.NUMBER_OF_COLOR_MAPS)]


def find_matplotlib_map(name):
    """A colour map of matplotlib, or None if there is none of that name."""
    try:
        import matplotlib
    except ImportError:
        return None
    return matplotlib.colormaps.get(name)


def make_table(name):
    """The lookup table of a map by its name: one of ours, or else one of matplotlib."""
    check_kind(name, str, "cmap", "the name of a colour map or a vtkScalarsToColors")
    table = vtkLookupTable()
    if name in list_maps():
        vtkCSLF.vtkCSLFSceneLook.SetUpLookupTable(list_maps().index(name) + 1, table)
        return table
    colors = find_matplotlib_map(name)
    if colors is None:
        known = ", ".join((*list_maps(), "a name that an installed matplotlib knows"))
        raise ValueError(f"cmap must be one of {known}, or a vtkScalarsToColors; it is {name!r}.")
    table.SetNumberOfTableValues(TABLE_SIZE)
    for i in range(TABLE_SIZE):
        table.SetTableValue(i, *colors(i / (TABLE_SIZE - 1)))
    table.SetNanColor(*colors(math.nan))
    return table


def get_range(value):
    """The smaller and the larger number of ``clim``."""
    expected = "two numbers, the first of which is smaller, such as (0.0, 5.0)"
    low, high = get_numbers(value, 2, float, "clim", expected)
    if not low < high:
        raise ValueError(f"clim must be {expected}; it is {value!r}.")
    return low, high


def color_scalars(mapper, scalars=None, cmap=None, clim=None):
    """Makes a mapper show a field's scalars in other colours. The arguments are those of
    ``make_actor``."""
    if scalars is None and cmap is None and clim is None:
        return
    shown = choose_scalars(mapper, scalars)
    limits = shown.range if clim is None else get_range(clim)
    if shown.is_logarithmic and limits[0] <= 0.0:
        raise ValueError(f"clim must be above 0, because the colour map of {shown.label} is "
                         f"logarithmic; it is {clim!r}.")
    if clim is not None:
        mapper.SetScalarRange(*limits)
    if isinstance(cmap, vtkScalarsToColors):
        mapper.SetLookupTable(cmap)
    elif cmap is not None or (has_no_map(mapper) and list_maps()):
        table = make_table(cmap or list_maps()[0])
        table.SetTableRange(*limits)
        if shown.is_logarithmic:
            table.SetScaleToLog10()
        mapper.SetLookupTable(table)


def measure(font, text):
    """The width of a text in pixels."""
    box = [0, 0, 0, 0]
    vtkTextRenderer.GetInstance().GetBoundingBox(font, text, box, DOTS_PER_INCH)
    return box[1] - box[0] + 1


def get_label_format(low, high):
    """Enough digits to tell labels from each other, and a space that parts them from the bar."""
    lost = int(math.log10(max(abs(low), abs(high)) / (high - low)))
    return f" %.{min(max(4 + lost, 4), 15)}g"


def make_scalar_bar(mapper, scalars, size, background):
    """The bar of a mapper's colours, at the right side of a picture; it looks like the tool's."""
    known = require_scalars(mapper, "show_scalar_bar")
    title = next(each.label for each in known
                 if scalars is None or each.find_name(scalars) is not None)
    table = mapper.GetLookupTable()
    if not table.IsA("vtkColorTransferFunction"):
        # The mapper leaves the range of a table as it is.
        copy = table.NewInstance()
        copy.DeepCopy(table)
        copy.SetRange(mapper.GetScalarRange())
        table = copy
    low, high = table.GetRange()
    bar = vtkScalarBarActor()
    bar.SetLookupTable(table)
    bar.SetTitle(title)
    bar.SetNumberOfLabels(LABELS)
    bar.SetMaximumNumberOfColors(512)
    bar.SetLabelFormat(get_label_format(low, high))
    bar.UnconstrainedFontSizeOn()
    bar.DrawBackgroundOn()  # between the texts and the scene
    bar.GetBackgroundProperty().SetColor(background)
    bar.GetBackgroundProperty().SetOpacity(0.6)
    luminance = sum(weight * level**2.2
                    for weight, level in zip((0.2126, 0.7152, 0.0722), background))
    for font in (bar.GetTitleTextProperty(), bar.GetLabelTextProperty()):
        font.SetFontSize(min(max(min(size) // 26, 10), 64))
        font.SetColor(*[0.0 if luminance > 0.18 else 1.0] * 3)
        font.BoldOff()
        font.ItalicOff()
        font.ShadowOff()
    place_bar(bar, size)
    return bar


def list_labels(bar):
    """The values at which a bar has labels, as texts."""
    table = bar.GetLookupTable()
    low, high = table.GetRange()
    parts = [i / (LABELS - 1) for i in range(LABELS)]
    if table.UsingLogScale():
        values = [low * (high / low)**part for part in parts]
    else:
        values = [low + part * (high - low) for part in parts]
    return [get_label_format(low, high) % value for value in values]


def place_bar(bar, size):
    """Gives a bar the place that its texts need."""
    width = size[0]
    font = bar.GetTitleTextProperty()
    letter = font.GetFontSize()
    title = measure(font, bar.GetTitle())
    if title > width / 2:
        font.SetFontSize(max(int(letter * width / 2 / title), 10))
        title = measure(font, bar.GetTitle())
    labels = max(measure(bar.GetLabelTextProperty(), text) for text in list_labels(bar))
    needed = max(title, 1.4 * letter + labels)
    bar.SetBarRatio(1.4 * letter / needed)
    bar.SetVerticalTitleSeparation(int(0.6 * letter))
    bar.SetPosition(1.0 - (needed + 0.8 * letter) / width, 0.1)
    bar.SetWidth(needed / width)
    bar.SetHeight(0.8)
