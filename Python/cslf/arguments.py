# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Checks of arguments. Their exceptions name the argument and say what is right: TypeError for what
is of a wrong kind, and ValueError for what is out of range or has a wrong name."""

import math
import operator
import os
import re

from vtkmodules.vtkCommonColor import vtkNamedColors
from vtkmodules.vtkCommonCore import vtkCommand

from .messages import Reports, get_text

MAXIMUM_SIZE = 16384  # of a picture, as the tool's


def check_kind(value, kinds, parameter, expected):
    """Raises TypeError if a value is none of these kinds, which ``expected`` says in words."""
    if not isinstance(value, kinds):
        raise TypeError(f"{parameter} must be {expected}; it is {value!r}.")


def get_file_name(value, parameter="file_name"):
    """The name of a file or folder as a string."""
    check_kind(value, (str, bytes, os.PathLike), parameter, "the name of a file, a str or a path")
    return os.fsdecode(value)


def find_name(value, names, parameter):
    """The index of a name, whose letters may be small or capital."""
    known = [name.lower() for name in names]
    if not isinstance(value, str) or value.lower() not in known:
        raise ValueError(f"{parameter} must be one of {', '.join(names)}; it is {value!r}.")
    return known.index(value.lower())


def get_numbers(value, count, convert, parameter, expected):
    """So many finite numbers. ``convert`` makes them from their items."""
    problem = f"{parameter} must be {expected}; it is {value!r}."
    try:
        numbers = () if isinstance(value, str) else tuple(convert(item) for item in value)
    except (TypeError, ValueError, OverflowError):
        numbers = ()
    if not numbers:
        raise TypeError(problem)
    if len(numbers) != count or not all(math.isfinite(number) for number in numbers):
        raise ValueError(problem)
    return numbers


def get_vector(value, parameter):
    """Three numbers."""
    return get_numbers(value, 3, float, parameter, "three numbers, such as (0.0, 1.0, 0.0)")


def get_size(value):
    """Width and height of a picture."""
    size = get_numbers(value, 2, operator.index, "size",
                       "width and height in pixels, such as (400, 400)")
    if min(size) < 1 or max(size) > MAXIMUM_SIZE:
        raise ValueError(f"size must be at least 1 x 1 and at most {MAXIMUM_SIZE} x {MAXIMUM_SIZE} "
                         f"pixels; it is {size[0]} x {size[1]}.")
    return size


def get_color(value, parameter):
    """Red, green and blue, from 0 to 1, of a colour or of its name in HTML."""
    expected = "a colour: a name, such as white or #1a1a1f, or three numbers from 0 to 1"
    if isinstance(value, str):
        red, green, blue, alpha = vtkNamedColors().HTMLColorToRGBA(value)
        if alpha != 255:
            raise ValueError(f"{parameter} must be {expected}; it is {value!r}.")
        return red / 255.0, green / 255.0, blue / 255.0
    color = get_numbers(value, 3, float, parameter, expected)
    if min(color) < 0.0 or max(color) > 1.0:
        raise ValueError(f"{parameter} must be {expected}; it is {value!r}.")
    return color


def set_parameters(target, parameters):
    """Sets those parameters that are not None. Raises ValueError for values outside of ranges."""
    problems = []

    def catch(_target, _event, message):
        problems.append(get_text(message))

    catch.CallDataType = "string0"
    with Reports():
        tag = target.AddObserver(vtkCommand.WarningEvent, catch)
        try:
            for name, value in parameters.items():
                if value is not None:
                    set_parameter(target, name, value, problems)
        finally:
            target.RemoveObserver(tag)


def set_parameter(target, name, value, problems):
    """Sets one parameter. What the setter warns of is appended to ``problems``."""
    keyword = re.sub(r"(?<=[a-z])(?=[A-Z])", "_", name).lower()
    setter = getattr(target, f"Set{name}")
    try:
        try:
            setter(value)
        except OverflowError:
            setter(2**31 - 1 if value > 0 else -2**31)  # is out of range, too
    except TypeError:
        expected = "a whole number" if isinstance(getattr(target, f"Get{name}")(), int) \
            else "a number"
        raise TypeError(f"{keyword} must be {expected}; it is {value!r}.") from None
    if problems:
        text = problems[0].partition(":")[0].replace(name, keyword, 1)
        raise ValueError(f"{text}; it is {value!r}.")
