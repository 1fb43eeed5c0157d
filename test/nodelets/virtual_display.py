# SPDX-License-Identifier: BSD-3-Clause
"""A display for tests that need a window."""

import contextlib
import os
import subprocess
import tempfile
from pathlib import Path

import numpy as np


@contextlib.contextmanager
def virtual_display(size):
    """Starts a display of this many pixels (width, height), which this process and its children
    use; yields the file with its pixels, in xwd format."""
    read, write = os.pipe()
    with tempfile.TemporaryDirectory() as runtime, \
            subprocess.Popen(["Xvfb", "-displayfd", str(write), "-screen", "0", "%dx%dx24" % size, "-fbdir",
                              runtime, "+extension", "GLX", "-nolisten", "tcp"], pass_fds=[write],
                             stderr=subprocess.DEVNULL) as xvfb:
        os.close(write)
        with os.fdopen(read) as answer:
            number = answer.readline().strip()
        if not number:
            raise RuntimeError("Xvfb ended before it had a display")
        os.environ.update(DISPLAY=":" + number, XDG_RUNTIME_DIR=runtime, LIBGL_ALWAYS_SOFTWARE="1",
                          QT_X11_NO_MITSHM="1")
        try:
            yield Path(runtime, "Xvfb_screen0")
        finally:
            xvfb.terminate()


def hues(screen_file, left=0):
    """Returns the hue (degrees, 0 to 360) of each pixel right of `left` (px); NaN if it is gray, pale or dark.

    screen_file: the memory of a virtual screen, in the form of xwd.
    """
    content = screen_file.read_bytes()
    header = np.frombuffer(content, ">u4", 25)
    begin, (height, stride) = header[0] + 12 * header[19], header[[5, 12]]
    pixels = np.frombuffer(content, np.uint8, height * stride, begin).reshape(height, stride // 4, 4)
    blue, green, red = np.moveaxis(pixels[:, left:, :3].astype(float), -1, 0)
    high, low = np.maximum(np.maximum(red, green), blue), np.minimum(np.minimum(red, green), blue)
    spread = np.where(high - low > 0.43 * high, high - low, np.nan)
    hue = np.select([high == red, high == green], [(green - blue) / spread, 2.0 + (blue - red) / spread],
                    4.0 + (red - green) / spread)
    return np.where(high > 90.0, 60.0 * hue % 360.0, np.nan)
