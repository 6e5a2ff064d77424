# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Ctrl-C ends long calls with KeyboardInterrupt, also while observers in Python are at work, and
leaves files that the next run resumes. Other threads go on meanwhile, and are ended when Python
exits. Each interrupted call would take hours."""
import contextlib
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import cslf
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkIOXML import vtkXMLImageDataWriter

# The main thread ends while another one is at work, which would begin again.
DAEMON = """
import sys
import threading
from TestCSLFInterrupt import cslf, make_encoder, make_slow_sampler

runs = threading.Event()

def run():
    while True:
        sampler = make_slow_sampler()
        sampler.AddObserver("ProgressEvent", lambda *_: runs.set())
        call = make_encoder(sys.argv[1], sampler).Write if sys.argv[1:] else sampler.Update
        call()

threading.Thread(target=run, daemon=True).start()
runs.wait()
"""


def make_sampler(samples, viewpoints=5, resolution=32):
    """A sampler of a sphere in a white sky. Each texel needs all its samples."""
    source = vtkSphereSource()
    sampler = cslf.vtkCSLFSampler()
    sampler.SetInputConnection(source.GetOutputPort())
    sampler.SetViewpoints(viewpoints)
    sampler.SetResolution(resolution)
    sampler.SetSamples(samples)
    sampler.SetNoiseTarget(0.0)
    sampler.SetIntegratorToPathTracing()
    sampler.SetGeometryTriangles(0)
    return sampler


def make_slow_sampler():
    return make_sampler(4096, 17, 64)


def make_encoder(name, sampler):
    encoder = cslf.vtkCSLFEncoder()
    encoder.SetInputConnection(sampler.GetOutputPort())
    encoder.SetFileName(name)
    encoder.SetPreset("ultrafast")
    return encoder


class Sender(threading.Thread):
    """Another thread, which needs Python's lock, sends Ctrl-C when a long call has begun: the call
    has its own handler."""

    def __init__(self):
        super().__init__()
        self.handler = signal.getsignal(signal.SIGINT)

    def run(self):
        while signal.getsignal(signal.SIGINT) == self.handler:
            time.sleep(0.01)
        os.kill(os.getpid(), signal.SIGINT)


def press_once(shares, minimum=0.3):
    """An observer that gets Ctrl-C while it is at work, when the share is reached."""
    def press(algorithm, _event):
        shares.append(algorithm.GetProgress())
        if shares[-1] > minimum and not getattr(press, "is_pressed", False):
            press.is_pressed = True
            signal.raise_signal(signal.SIGINT)
            # KeyboardInterrupt would be raised here.
            for share in list(shares):
                shares[0] = min(shares[0], share)
    return press


class TestCSLFInterrupt(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.handler = signal.getsignal(signal.SIGINT)

    def tearDown(self):
        shutil.rmtree(self.folder)
        self.assertIs(signal.getsignal(signal.SIGINT), self.handler)

    def get_name(self, name):
        return os.path.join(self.folder, name)

    def expect_interrupt(self, call, *arguments):
        sender = Sender()
        sender.start()
        with self.assertRaises(KeyboardInterrupt):
            call(*arguments)
        sender.join()
        self.assertEqual(cslf.vtkCSLFSampler.GetGlobalWarningDisplay(), 1)

    def test_update(self):
        sampler = make_slow_sampler()
        self.expect_interrupt(sampler.Update)
        self.assertEqual(sampler.GetOutput().GetNumberOfPoints(), 0)
        # It is not aborted for ever, and not up to date.
        sampler.SetViewpoints(2)
        sampler.SetSamples(1)
        sampler.Update()
        self.assertEqual(sampler.GetOutput().GetDimensions()[2], 24)

    def test_writers(self):
        """A file appears only when it is complete, also by a writer of VTK's own."""
        sampler = make_slow_sampler()
        image_data = vtkXMLImageDataWriter()
        image_data.SetInputConnection(sampler.GetOutputPort())
        images = cslf.vtkCSLFImageWriter()
        images.SetInputConnection(sampler.GetOutputPort())
        for writer, name in ((image_data, "field.vti"), (images, "field")):
            writer.SetFileName(self.get_name(name))
            self.expect_interrupt(writer.Write)
            self.assertFalse(os.path.exists(self.get_name(name)))

    def test_observer(self):
        """VTK ends the process if KeyboardInterrupt reaches it from an observer."""
        sampler = make_sampler(samples=64)
        shares = []
        ends = []
        sampler.AddObserver("ProgressEvent", press_once(shares))
        sampler.AddObserver("EndEvent", lambda *_: ends.append(sum(value for value in range(100))))
        with self.assertRaises(KeyboardInterrupt):
            sampler.Update()
        self.assertEqual(ends, [4950])
        self.assertEqual(sampler.GetOutput().GetNumberOfPoints(), 0)

    def test_failing_observer(self):
        """One that raises an exception at each event, which VTK prints."""
        def fail(_algorithm, _event):
            raise KeyError("mine")

        sampler = make_slow_sampler()
        sampler.AddObserver("ProgressEvent", fail)
        with open(os.devnull, "w", encoding="utf-8") as nothing, \
                contextlib.redirect_stderr(nothing):
            self.expect_interrupt(sampler.Update)

    def test_builtin_observer(self):
        """One that is no function of Python: VTK calls it last when the call has ended."""
        sampler = make_slow_sampler()
        sampler.AddObserver("AnyEvent", print)
        with open(os.devnull, "w", encoding="utf-8") as nothing, \
                contextlib.redirect_stdout(nothing):
            self.expect_interrupt(sampler.Update)

    def test_builtin_caller(self):
        """The exception is raised in the function that runs when VTK has returned."""
        samplers = [make_slow_sampler() for _ in range(3)]
        self.expect_interrupt(list, map(cslf.vtkCSLFSampler.Update, samplers))

    def test_exit(self):
        """Python exits while a daemon thread is at work: its call is ended, and leaves what an
        interrupted one leaves."""
        cases = [[]]
        if hasattr(cslf, "vtkCSLFEncoder"):
            cases.append([self.get_name("field.mp4")])
        for arguments in cases:
            result = subprocess.run([sys.executable, "-c", DAEMON, *arguments],
                                    cwd=os.path.dirname(os.path.abspath(__file__)),
                                    stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                    check=False)
            self.assertEqual((result.returncode, result.stdout), (0, ""))
        self.assertLessEqual(set(os.listdir(self.folder)), {"field.mp4.partial"})

    def test_message_switch(self):
        """Two threads bake, and share VTK's switch of messages. The second outlasts the first."""
        first_began, second_began, first_ended = (threading.Event() for _ in range(3))

        def bake(began, other):
            def report(_phase, _share):
                began.set()
                other.wait()
            cslf.bake(vtkSphereSource(), viewpoints=2, resolution=16, progress=report)

        cslf.vtkCSLFSampler.SetGlobalWarningDisplay(0)
        try:
            first = threading.Thread(target=bake, args=(first_began, second_began))
            second = threading.Thread(target=bake, args=(second_began, first_ended))
            first.start()
            first_began.wait()
            second.start()
            first.join()
            display = cslf.vtkCSLFSampler.GetGlobalWarningDisplay()
            first_ended.set()
            second.join()
            self.assertEqual((display, cslf.vtkCSLFSampler.GetGlobalWarningDisplay()), (1, 0))
        finally:
            cslf.vtkCSLFSampler.SetGlobalWarningDisplay(1)

    def test_other_exception(self):
        """A handler of the user is called at once. What it raises ends the call, nothing else."""
        calls = []

        def count(_signal, _frame):
            calls.append(True)
            if len(calls) > 1:
                raise TimeoutError("too long")

        before = signal.signal(signal.SIGINT, count)
        try:
            sampler = make_sampler(samples=16)
            sampler.AddObserver("ProgressEvent", press_once([]))
            sampler.Update()
            self.assertEqual(len(calls), 1)
            self.assertGreater(sampler.GetOutput().GetNumberOfPoints(), 0)
            sampler.SetSeed(1)
            sampler.AddObserver("ProgressEvent", press_once([]))
            with self.assertRaisesRegex(TimeoutError, "too long"):
                sampler.Update()
        finally:
            self.assertIs(signal.signal(signal.SIGINT, before), count)

    def test_threads(self):
        """A thread that is at work while another one samples."""
        sampler = make_sampler(samples=32)
        turns = []
        ended = threading.Event()

        def turn():
            while not ended.is_set():
                turns.append(sampler.GetProgress())
                time.sleep(0.001)

        thread = threading.Thread(target=turn)
        thread.start()
        start = len(turns)
        sampler.Update()
        during = len(turns) - start
        ended.set()
        thread.join()
        self.assertGreater(during, 10)

    def test_other_thread(self):
        """Only Python's main thread gets Ctrl-C. Calls in others go on."""
        sampler = make_sampler(samples=4)
        thread = threading.Thread(target=sampler.Update)
        with self.assertRaises(KeyboardInterrupt):
            thread.start()
            signal.raise_signal(signal.SIGINT)
            time.sleep(0.0)
        thread.join()
        self.assertEqual(sampler.GetOutput().GetDimensions()[2], 150)

    @unittest.skipUnless(hasattr(cslf, "vtkCSLFEncoder"), "without the encoder")
    def test_resume(self):
        sampler = make_sampler(samples=16)
        whole, resumed = self.get_name("whole.mp4"), self.get_name("resumed.mp4")
        self.assertEqual(make_encoder(whole, sampler).Write(), 1)
        encoder = make_encoder(resumed, sampler)
        # Groups of viewpoints are stored then.
        tag = encoder.AddObserver("ProgressEvent", press_once([], 0.6))
        with self.assertRaises(KeyboardInterrupt):
            encoder.Write()
        encoder.RemoveObserver(tag)
        self.assertEqual(sorted(os.listdir(self.folder)), ["resumed.mp4.partial", "whole.mp4"])
        rays = sampler.GetNumberOfRays()
        self.assertEqual(encoder.Write(), 1)
        self.assertLess(sampler.GetNumberOfRays() - rays, rays)
        with open(whole, "rb") as first, open(resumed, "rb") as second:
            self.assertEqual(first.read(), second.read())

    @unittest.skipUnless(hasattr(cslf, "vtkCSLFEncoder"), "without the encoder")
    def test_bake(self):
        """With a progress bar, which is an observer."""
        name = self.get_name("field.mp4")
        with open(os.devnull, "w", encoding="utf-8") as nothing:
            pressed = []

            def press(_phase, share):
                print(share, file=nothing)
                if share > 0.6 and not pressed:
                    pressed.append(share)
                    signal.raise_signal(signal.SIGINT)

            with self.assertRaises(KeyboardInterrupt):
                cslf.bake(vtkSphereSource(), name, viewpoints=5, resolution=32, samples=16,
                          progress=press)
        self.assertEqual(os.listdir(self.folder), ["field.mp4.partial"])


if __name__ == "__main__":
    unittest.main()
