# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""What algorithms of VTK report, as exceptions, warnings and progress of Python."""

import os
import re
import sys
import threading
import time
import warnings

from vtkmodules.vtkCommonCore import vtkCommand, vtkObject


class Error(RuntimeError):
    """Why a light field could not be made, read or written."""


def find_producers(algorithm):
    """An algorithm and all that feed it."""
    found = []

    def visit(producer):
        if producer is None or producer in found:
            return
        found.append(producer)
        for port in range(producer.GetNumberOfInputPorts()):
            for index in range(producer.GetNumberOfInputConnections(port)):
                visit(producer.GetInputAlgorithm(port, index))

    visit(algorithm)
    return found


def get_text(message):
    """The sentence of a message of VTK, without its file, line, class and address."""
    text = message.strip().splitlines()[-1] if message.strip() else ""
    return re.sub(r"^\w+ \((0x)?[0-9a-fA-F]+\): ", "", text)


def raise_error(text, kind=Error):
    """Raises the exception that fits the reason: one of that kind, unless memory is missing."""
    raise (MemoryError if "there is not enough memory" in text else kind)(text)


def find_caller():
    """The stack level, to the function that calls this one, of the first frame that is not of this
    package."""
    level = 1
    frame = sys._getframe(1)
    while frame.f_back and os.path.dirname(frame.f_code.co_filename) == os.path.dirname(__file__):
        frame = frame.f_back
        level += 1
    return level


class Reports:
    """Has VTK's objects report to their observers, also for those who have switched messages off,
    who want the reasons in exceptions nevertheless. VTK's switch is one for all threads."""

    _lock = threading.Lock()
    _number = 0  # that are in use

    def __enter__(self):
        with Reports._lock:
            if Reports._number == 0:
                Reports._display = vtkObject.GetGlobalWarningDisplay()
                vtkObject.SetGlobalWarningDisplay(1)
            Reports._number += 1
            self.is_on = bool(Reports._display)  # the user's choice
        return self

    def __exit__(self, _kind, _error, _trace):
        with Reports._lock:
            Reports._number -= 1
            if Reports._number == 0:
                vtkObject.SetGlobalWarningDisplay(Reports._display)


class Messages:
    """Collects what an algorithm, all that feed it, and other objects report. Warnings become those
    of Python."""

    def __init__(self, algorithm, *others):
        self._algorithm = algorithm
        self._others = others
        self.errors = []
        self.warnings = []

    def __enter__(self):
        self._reports = Reports().__enter__()
        self._tags = []
        algorithms = find_producers(self._algorithm)
        for algorithm in algorithms:
            # The executive only repeats that its algorithm has failed.
            self._add(algorithm.GetExecutive(), vtkCommand.ErrorEvent, [])
        for sender in (*algorithms, *self._others):
            self._add(sender, vtkCommand.ErrorEvent, self.errors)
            self._add(sender, vtkCommand.WarningEvent, self.warnings)
        return self

    def _add(self, sender, event, texts):
        def catch(_sender, _event, message):
            texts.append(get_text(message))
        catch.CallDataType = "string0"
        self._tags.append((sender, sender.AddObserver(event, catch)))

    def __exit__(self, kind, error, trace):
        for sender, tag in self._tags:
            sender.RemoveObserver(tag)
        self._reports.__exit__(kind, error, trace)
        if kind is None and self._reports.is_on:
            for text in dict.fromkeys(self.warnings):
                warnings.warn(text, stacklevel=find_caller())

    def require(self, is_done, otherwise, kind=Error):
        """Raises the first error, if there was one or nothing was done."""
        if self.errors or not is_done:
            raise_error(self.errors[0] if self.errors else otherwise, kind)


def is_notebook():
    """Whether the output is a notebook's."""
    shell = sys.modules.get("IPython")
    shell = shell and shell.get_ipython()
    return shell is not None and type(shell).__name__ == "ZMQInteractiveShell"


def format_seconds(seconds):
    """Such as 0:07 or 1:02:03."""
    minutes, seconds = divmod(int(seconds + 0.5), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02}:{seconds:02}" if hours else f"{minutes}:{seconds:02}"


class Line:
    """A progress bar of one line: the phase, the share that is done, and the time that is left. It
    is tqdm's if that is installed."""

    WIDTH = 24
    PAUSE = 0.1  # seconds between two pictures of it

    def __init__(self):
        self._start = time.monotonic()
        self._next = 0.0
        self._length = 0
        self._bar = None

    def _open(self, phase):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # notebooks may lack its widgets
            try:
                from tqdm.auto import tqdm
            except ImportError:
                return
            self._bar = tqdm(total=100, desc=phase, leave=False,
                             bar_format="{desc}: {percentage:3.0f} %|{bar}| {elapsed}{postfix}")

    def __call__(self, phase, share):
        now = time.monotonic()
        if now < self._next and share < 1.0:
            return
        if self._next == 0.0:
            self._open(phase)
        self._next = now + self.PAUSE
        spent = now - self._start
        # The first shares tell little about the others.
        left = ""
        if share > 0.02 and spent > 1.0:
            left = f", {format_seconds(spent * (1.0 - share) / share)} left"
        if self._bar is not None:
            self._bar.set_description_str(phase, refresh=False)
            self._bar.set_postfix_str(left[2:], refresh=False)
            self._bar.n = round(100 * share)
            self._bar.refresh()
            return
        done = round(self.WIDTH * share)
        self._write(f"{phase} [{'#' * done}{'.' * (self.WIDTH - done)}] {share:4.0%}{left}")

    def _write(self, text):
        sys.stderr.write("\r" + text.ljust(self._length))
        sys.stderr.flush()
        self._length = len(text)

    def close(self):
        """Removes the line."""
        if self._bar is not None:
            self._bar.close()
        elif self._length > 0:
            self._write("")
            sys.stderr.write("\r")
            self._length = 0


class Progress:
    """Reports the progress of an algorithm while it is at work.

    ``progress`` is a function that gets the phase and the share that is done, from 0 to 1, or
    whether to draw a bar; None draws one in terminals and notebooks.
    """

    def __init__(self, algorithm, progress, phase):
        self._algorithm = algorithm
        self._phase = phase
        self._error = None
        self._line = None
        if progress is None:
            progress = is_notebook() or (sys.stderr is not None and sys.stderr.isatty()
                                         and os.environ.get("TERM") != "dumb")
        if progress and not callable(progress):
            progress = self._line = Line()
        self._report = progress

    def __enter__(self):
        self._tag = None
        if self._report:
            self._tag = self._algorithm.AddObserver(vtkCommand.ProgressEvent, self._observe)
        return self

    def _observe(self, algorithm, _event):
        # VTK prints the exceptions of observers, so the first one is kept, and ends the work.
        if self._error is None:
            try:
                self._report(algorithm.GetProgressText() or self._phase, algorithm.GetProgress())
            except BaseException as error:
                self._error = error
        if self._error is not None:
            algorithm.SetAbortExecute(1)

    def __exit__(self, _kind, _error, _trace):
        if self._tag is not None:
            self._algorithm.RemoveObserver(self._tag)
        if self._error is not None:
            self._algorithm.SetAbortExecute(0)  # VTK since 9.3 does not reset it
        if self._line is not None:
            self._line.close()
        if self._error is not None:
            raise self._error
