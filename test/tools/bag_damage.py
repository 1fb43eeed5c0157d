# SPDX-License-Identifier: BSD-3-Clause
"""Damages the bytes of a bag as disks, transfers and killed recorders do, at random with a seed."""

import functools
import math
import struct
from typing import NamedTuple

CHUNK, INDEX, CONNECTION = 5, 4, 7  # the op of these records of the bag format 2.0
NUMBER, ENTRY = 4, 12  # bytes, of a length, and of a message in an index
MAX_LENGTH = 4096  # bytes, of a damaged range; lengths are log-uniform
KINDS = ("ones", "zeros", "random bytes", "cut", "repeated", "removed", "chunk repeated", "chunk removed")


class Damaged(NamedTuple):
    """A damaged bag, and in words what was done to it."""

    content: bytes
    what: str


def flipped(content, random):
    """Returns the bag (bytes) with one bit flipped, as Damaged. random: numpy Generator."""
    at, bit = int(random.integers(len(content))), int(random.integers(8))
    changed = bytearray(content)
    changed[at] ^= 1 << bit
    return Damaged(bytes(changed), f"bit {bit} of byte {at} flipped")


def with_damaged_range(content, random):
    """Returns the bag (bytes) with one of KINDS, as Damaged. random: numpy Generator."""
    kind = KINDS[int(random.integers(len(KINDS)))]
    if kind.startswith("chunk"):
        found = chunks(content)
        begin, end = found[int(random.integers(len(found)))]
    else:
        length = int(math.exp(random.uniform(0.0, math.log(MAX_LENGTH))))
        begin = int(random.integers(len(content)))
        end = min(begin + length, len(content))
    head, part, tail = content[:begin], content[begin:end], content[end:]
    if kind == "cut":
        return Damaged(head, f"cut after {begin} bytes")
    replaced = {
        "ones": b"\xff" * len(part),
        "zeros": bytes(len(part)),
        "random bytes": random.bytes(len(part)),
    }.get(kind, 2 * part if kind.endswith("repeated") else b"")
    return Damaged(head + replaced + tail, f"bytes {begin} to {end}: {kind}")


def with_flipped_number(content, random):
    """Returns the bag (bytes) with one bit flipped in a number that says where something is or how long
    it is, as Damaged: they are few, but a reader that trusts them leaves its memory."""
    at, what = _numbers(content)[int(random.integers(len(_numbers(content))))]
    bit = int(random.integers(8 * NUMBER))
    changed = bytearray(content)
    changed[at + bit // 8] ^= 1 << bit % 8
    return Damaged(bytes(changed), f"bit {bit} of the {what} at byte {at} flipped")


def chunks(content):
    """Returns [(begin, end)] (bytes) of the chunks of an intact bag, each with the records that index
    its messages."""
    found = []
    for at, op, _, end in _records(content, content.index(b"\n") + 1, len(content)):
        if op == CHUNK:
            found.append((at, end))
        elif op == INDEX:
            found[-1] = (found[-1][0], end)
    return found


@functools.cache
def _numbers(content):
    """Returns [(byte, what)] of the 32-bit numbers of an intact bag: lengths, offsets and counts."""
    found = []
    for at, op, data, end in _records(content, content.index(b"\n") + 1, len(content)):
        found += [(at, f"length of a header (op {op})"), (data - NUMBER, f"length of data (op {op})")]
        header = content[at:data]
        found += _field_lengths(content, at + NUMBER, data - NUMBER, op)
        if op == CONNECTION:  # its data is a header, too
            found += _field_lengths(content, data, end, op)
        for name in (b"size=", b"count=", b"conn_count=", b"chunk_count=", b"index_pos=", b"chunk_pos="):
            if name in header:
                found.append((at + header.index(name) + len(name), name.decode() + f" (op {op})"))
        if op == INDEX:
            found += [(entry + 8, "offset of a message") for entry in range(data, end, ENTRY)]
        elif op == CHUNK and b"compression=none" in header:
            for inner, inner_op, inner_data, _ in _records(content, data, end):
                found += _field_lengths(content, inner + NUMBER, inner_data - NUMBER, inner_op)
                found.append((inner, "length of a message's header"))
                found.append((inner_data - NUMBER, "length of a message"))
    return found


def _field_lengths(content, at, end, op):
    """Returns [(byte, what)] of the lengths of the fields of a header."""
    found = []
    while at < end:
        found.append((at, f"length of a field (op {op})"))
        at += NUMBER + struct.unpack_from("<I", content, at)[0]
    return found


def _records(content, begin, end):
    """Yields the first byte, the op, the first byte of the data, and the end of each record."""
    while begin < end:
        data = begin + 2 * NUMBER + struct.unpack_from("<I", content, begin)[0]
        header = content[begin + NUMBER : data - NUMBER]
        after = data + struct.unpack_from("<I", content, data - NUMBER)[0]
        yield begin, header[header.index(b"op=") + 3], data, after
        begin = after
