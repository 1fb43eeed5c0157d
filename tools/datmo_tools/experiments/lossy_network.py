# SPDX-License-Identifier: BSD-3-Clause
"""Emulates computers by Linux network namespaces, joined by a network with delays and losses.

Each namespace has a TUN device, and a process of ours forwards whole IP packets from one to the
other, like a router: it delays them, and drops some, so that TCP resends them. Packets may overtake
each other, as with netem. Requires root.
"""

import contextlib
import errno
import fcntl
import heapq
import multiprocessing
import os
import random
import select
import shutil
import signal
import socket
import struct
import subprocess
import time
from pathlib import Path
from typing import NamedTuple

TUN = Path("/dev/net/tun")
TUNSETIFF, IFF_TUN, IFF_NO_PI = 0x400454CA, 0x0001, 0x1000  # linux/if_tun.h
LARGEST_PACKET = 65536  # bytes
DESTINATION = slice(16, 20)  # of the address in an IPv4 header
SUBNET = "10.77.0"
MOST_WAITING = 20000  # packets, of the router's buffer: further ones are lost
PARENT_CHECK = 1.0  # s


class Quality(NamedTuple):
    """Link of each direction from one computer to another."""

    delay: float = 0.0  # s
    jitter: float = 0.0  # s; each packet's delay is uniform within delay +- jitter
    loss: float = 0.0  # probability of a packet
    seed: int = 1


def why_not():
    """Returns why there can be no such network here (text), or None."""
    if os.geteuid() != 0:
        return "only root may make network namespaces"
    if shutil.which("ip") is None:
        return "no program ip: expected Debian's package iproute2"
    if not TUN.exists():
        return f"no {TUN}: expected a kernel with TUN devices"
    try:
        with LossyNetwork(2, Quality()) as network:
            network.ping()
    except (OSError, subprocess.CalledProcessError) as error:
        said = getattr(error, "stderr", None)
        return f"no network namespaces: {(said or str(error)).strip()}"
    return None


class LossyNetwork:
    """Context manager of `computers` namespaces, which reach each other at address(0) etc."""

    def __init__(self, computers, quality):
        self._quality = quality
        self._names = [f"datmo_{os.getpid()}_{i}" for i in range(computers)]
        self._devices = []
        self._relay = None

    def __enter__(self):
        try:
            for i, name in enumerate(self._names):
                self._devices.append(self._connect(i, name))
            devices = {socket.inet_aton(self.address(i)): device for i, device in enumerate(self._devices)}
            self._relay = multiprocessing.get_context("fork").Process(
                target=_relay, args=(devices, self._quality, os.getpid()), daemon=True)
            self._relay.start()
        except BaseException:
            self._end()
            raise
        return self

    def __exit__(self, *_):
        self._end()

    def address(self, computer):
        return f"{SUBNET}.{computer + 1}"

    def name(self, computer):
        """Returns the name of its namespace."""
        return self._names[computer]

    def command(self, computer, words):
        """Returns the words of a command that runs others there."""
        return ["ip", "netns", "exec", self._names[computer], *map(str, words)]

    def ping(self):
        """Connects the first computer to the last one by TCP. Raises OSError if it cannot."""
        code = ("import socket, sys\n"
                "try: socket.create_connection((sys.argv[1], 9), timeout=5)\n"
                "except ConnectionRefusedError: pass\n")
        last = len(self._names) - 1
        _checked(*self.command(0, ["/usr/bin/python3", "-c", code, self.address(last)]))

    def _connect(self, computer, name):
        """Creates a namespace with its device; returns the device's file descriptor."""
        _checked("ip", "netns", "add", name)
        device = os.open(TUN, os.O_RDWR | os.O_NONBLOCK)
        interface = f"datmo{computer}"
        fcntl.ioctl(device, TUNSETIFF, struct.pack("16sH", interface.encode(), IFF_TUN | IFF_NO_PI))
        _checked("ip", "link", "set", interface, "netns", name)
        _checked("ip", "-n", name, "address", "add", f"{self.address(computer)}/24", "dev", interface)
        _checked("ip", "-n", name, "link", "set", "lo", "up")
        _checked("ip", "-n", name, "link", "set", interface, "up")
        return device

    def _end(self):
        if self._relay is not None:
            self._relay.terminate()
            self._relay.join()
        for device in self._devices:
            os.close(device)
        self._devices = []
        for name in self._names:
            _end_processes(name)
            subprocess.run(["ip", "netns", "delete", name], stderr=subprocess.DEVNULL, check=False)


def _checked(*words):
    subprocess.run(words, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, encoding="utf-8")


def _end_processes(name):
    """Kills the processes left in one of our namespaces."""
    left = subprocess.run(["ip", "netns", "pids", name], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                          encoding="utf-8", check=False).stdout
    for process in left.split():
        with contextlib.suppress(ProcessLookupError):
            os.kill(int(process), signal.SIGKILL)


def _relay(devices, quality, parent):
    """Forwards packets until it or its parent ends. devices: file descriptors by address."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # from a terminal: the parent ends this process
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    chance = random.Random(quality.seed)
    waiting, number = [], 0
    while os.getppid() == parent:
        wait = max(0.0, waiting[0][0] - time.monotonic()) if waiting else PARENT_CHECK
        ready, _, _ = select.select(list(devices.values()), [], [], min(wait, PARENT_CHECK))
        now = time.monotonic()
        for device in ready:
            for packet in _packets(device):
                to = devices.get(packet[DESTINATION])
                if to is None or chance.random() < quality.loss or len(waiting) >= MOST_WAITING:
                    continue
                due = now + quality.delay + quality.jitter * chance.uniform(-1.0, 1.0)
                number += 1
                heapq.heappush(waiting, (due, number, to, packet))
        while waiting and waiting[0][0] <= time.monotonic():
            _, _, to, packet = heapq.heappop(waiting)
            _write(to, packet)


def _packets(device):
    """Yields the packets that have arrived."""
    while True:
        try:
            yield os.read(device, LARGEST_PACKET)
        except BlockingIOError:
            return


def _write(device, packet):
    """Writes a packet; a device that is down, or whose queue is full, loses it."""
    try:
        os.write(device, packet)
    except OSError as error:
        if error.errno not in (errno.EIO, errno.EAGAIN, errno.ENOBUFS):
            raise
