# SPDX-License-Identifier: BSD-3-Clause
"""Opens bags for reading, or raises an error with what is wrong and what to do about it.

tools/input_bag.cpp has the same messages.
"""

import contextlib
import os
import struct
import traceback
from pathlib import Path

import genpy
import rosbag

from datmo_tools.errors import InputError

BAG_MAGIC = b"#ROSBAG"
BAG_VERSION = b"#ROSBAG V2.0\n"  # the only format that is read
ROS2_MAGICS = (b"SQLite format 3\0", b"\x89MCAP0\r\n")
ROS2_SUFFIXES = (".db3", ".mcap")
# The first bytes of compressed files, and the command that unpacks them.
PACKED = {
    b"PK\x03\x04": "unzip",
    b"\x1f\x8b": "gunzip",
    b"BZh": "bunzip2",
    b"\xfd7zXZ\0": "unxz",
    b"\x28\xb5\x2f\xfd": "unzstd",
    b"7z\xbc\xaf\x27\x1c": "7z x",
}
OTHER_VERSION_ADVICE = "doc/interfaces.md says what 'rosbag fix' converts"
MAX_NAMES = 3  # of the bags in a folder that a message lists


@contextlib.contextmanager
def opened(path):
    """Context manager of a rosbag.Bag that is read; uncompressed, bz2 or lz4.

    path: of the bag (Path or str). Raises InputError, with the file, what is wrong and what to do,
    also if reading fails later within the context.
    """
    path = Path(path)
    fault = fault_of(path)
    if fault:
        raise InputError(f"{path}: {fault}")
    try:
        with rosbag.Bag(str(path)) as bag:
            if bag.get_message_count() == 0:
                raise InputError(f"{path}: holds no message, expected a recording")
            yield bag
    except rosbag.ROSBagUnindexedException as error:
        raise InputError(
            f"{path}: has no index: it was cut short, or is still being written;"
            f" 'rosbag reindex {path}' recovers its messages"
        ) from error
    except (
        OSError,
        EOFError,
        RuntimeError,  # of roslz4
        struct.error,
        rosbag.ROSBagException,
        genpy.MessageException,
    ) as error:
        raise InputError(f"{path}: cannot be read as a bag ({_reason(error)})") from error
    except (LookupError, ValueError, ArithmeticError, AttributeError) as error:
        if not _is_of_reader(error):
            raise
        # rosbag has no words for a wrong name or number in a damaged record.
        kind = type(error).__name__
        raise InputError(f"{path}: cannot be read as a bag ({kind} in a record: {error})") from error


def _is_of_reader(error):
    """Returns whether rosbag or genpy has raised an exception, not the code that uses them."""
    file = Path(traceback.extract_tb(error.__traceback__)[-1].filename)
    return file.parent in (Path(rosbag.__file__).parent, Path(genpy.__file__).parent)


def check_type(path, topic, message, kind):
    """Raises InputError if a message of a bag is not of a type (its class), or another version."""
    # pylint: disable=protected-access
    if message._type != kind._type:
        raise InputError(f"{path}: {topic} is {message._type}, expected {kind._type}")
    if message._md5sum != kind._md5sum:
        raise InputError(f"{path}: {topic} is {other_version(kind._type)}; {OTHER_VERSION_ADVICE}")


def other_version(datatype):
    """Returns what messages of this type are whose definition is not the installed one."""
    return f"another version of {datatype}, expected ours"


def fault_of(path):
    """Returns what is wrong with a file (Path) before it is opened as a ROS 1 bag, or None."""
    if not path.exists():
        return "no such file"
    if path.is_dir():
        return _fault_of_folder(path)
    if not path.is_file():
        return "is a pipe or a device, expected a file: a bag's index is at its end"
    if not os.access(path, os.R_OK):
        return f"no permission to read it; 'chmod u+r {path}' by its owner grants it"
    return _fault_of_content(path)


def _fault_of_folder(path):
    names = sorted(entry.name for entry in path.iterdir())
    if "metadata.yaml" in names or any(name.endswith(ROS2_SUFFIXES) for name in names):
        return _ros2_fault(path)
    bags = [name for name in names if name.endswith(".bag")]
    more = ", ..." if len(bags) > MAX_NAMES else ""
    held = f"; it holds {', '.join(bags[:MAX_NAMES])}{more}" if bags else ""
    advice = (
        "; 'rosrun datmo_fusion merge_bags' merges a recording's parts into one bag"
        if len(bags) > 1
        else ""
    )
    return f"is a folder, expected a bag{held}{advice}"


def _fault_of_content(path):
    with path.open("rb") as stream:
        head = stream.read(max(map(len, ROS2_MAGICS)))
    if not head:
        return "is empty (0 bytes), expected a bag"
    if head.startswith(BAG_VERSION):
        return None
    if head.startswith(BAG_MAGIC):
        return (
            "is not of bag format 2.0, expected '#ROSBAG V2.0' as its first line, which rosbag writes"
            " since 2010"
        )
    if head.startswith(ROS2_MAGICS):
        return _ros2_fault(path)
    for magic, command in PACKED.items():
        if head.startswith(magic):
            return f"is compressed, expected a bag; '{command} {path}' unpacks it"
    return f"is not a bag, expected a file that begins with {BAG_MAGIC.decode()}"


def _ros2_fault(path):
    return (
        "is a recording of ROS 2, expected a bag of ROS 1; 'pip install rosbags' and"
        f" 'rosbags-convert --src {path} --dst ros1.bag' convert it"
    )


def _reason(error):
    """Returns rosbag's error text; for an unsupported compression it names the missing module."""
    if "lz4" in str(error) and isinstance(error, rosbag.ROSBagException):
        return f"{error}: expected the package python3-roslz4"
    return str(error) or type(error).__name__
