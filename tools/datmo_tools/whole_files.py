# SPDX-License-Identifier: BSD-3-Clause
"""Writes files either all together or not at all."""

import contextlib
import os

from datmo_tools.errors import InputError


def check_folder(folder):
    """Raises InputError if `folder` (Path), which need not exist yet, cannot be written.

    To be called before work whose result it will hold.
    """
    there = folder.resolve()
    while not there.exists():
        there = there.parent
    if not there.is_dir():
        raise InputError(f"{folder}: cannot be written: {there} is no folder")
    if not os.access(there, os.W_OK | os.X_OK):
        raise InputError(f"{folder}: cannot be written: no permission to write in {there}")


def write_file(path, text):
    """Writes one file (Path), of str or bytes, as write_whole() does."""
    write_whole(path.parent, {path.name: text})


def write_whole(folder, texts):
    """Writes files to `folder` (Path), which is created if needed.

    texts: name -> str or bytes. Each file gets its name only when all are on disk; until then,
    existing files of these names remain.
    """
    parts = {name: folder / (name + ".part") for name in texts}
    try:
        folder.mkdir(parents=True, exist_ok=True)
        for name, text in texts.items():
            # Bytes of a file's name that are not UTF-8 are escaped: the text has to stay readable.
            data = text if isinstance(text, bytes) else text.encode("utf-8", "backslashreplace")
            parts[name].write_bytes(data)
        for name, part in parts.items():
            os.replace(part, folder / name)
    except OSError as error:
        raise InputError(f"{folder}: cannot be written: {error}") from error
    finally:
        for part in parts.values():
            with contextlib.suppress(OSError):
                part.unlink()
