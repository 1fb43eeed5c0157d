# SPDX-License-Identifier: BSD-3-Clause
"""A display for tests that need a window."""

import contextlib
import os
import subprocess
import tempfile
from pathlib import Path


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
