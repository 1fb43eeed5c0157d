# SPDX-License-Identifier: BSD-3-Clause
"""Runs roslaunch, which reaches its machines by `ip netns exec` instead of ssh.

usage: namespaced_roslaunch ADDRESS=NAMESPACE... -- WORD OF ROSLAUNCH...
"""

import contextlib
import os
import socket
import subprocess
import sys
from unittest import mock

import roslaunch
from roslaunch.remoteprocess import SSHChildROSLaunchProcess


class _Pipe:
    """One end of a process's pipe, like paramiko's channel files; never waits for data."""

    def __init__(self, pipe):
        self._pipe = pipe
        self.channel = self
        os.set_blocking(pipe.fileno(), False)

    def settimeout(self, _seconds):
        """Never waits."""

    def read(self, size):
        try:
            return os.read(self._pipe.fileno(), size)
        except BlockingIOError:
            raise socket.timeout from None

    def close(self):
        with contextlib.suppress(OSError):
            self._pipe.close()


class _Connection:
    """The process on the other machine, with the interface of paramiko's connection."""

    def __init__(self, process):
        self._process = process

    def close(self):
        with contextlib.suppress(ProcessLookupError):
            self._process.terminate()
        self._process.wait()


def _execute_in(namespaces):
    def execute(self, command, address, _port, _username=None, _password=None):
        words = ["ip", "netns", "exec", namespaces[address], "env", f"ROS_MASTER_URI={self.master_uri}",
                 *command.split()]
        process = subprocess.Popen(words, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        pipes = map(_Pipe, (process.stdin, process.stdout, process.stderr))
        return (_Connection(process), *pipes), "executed in its namespace"
    return execute


def main():
    """Returns the exit code."""
    end = sys.argv.index("--")
    namespaces = dict(word.split("=", 1) for word in sys.argv[1:end])
    with mock.patch.object(SSHChildROSLaunchProcess, "_ssh_exec", _execute_in(namespaces)):
        roslaunch.main(["roslaunch", *sys.argv[end + 1:]])
    return 0
