# SPDX-License-Identifier: BSD-3-Clause
"""The network that classifies objects in the images of a drive; its file is beside the recordings."""

NETWORK = "models/yolox_nano/yolox_nano.onnx"


def network_of(bench, step):
    """Returns the network's file (Path); None without it, and says so for the step (its name)."""
    file = bench.data.parent / NETWORK
    if not file.is_file():
        print(f"{step}: network left out, {file} is not there")
        return None
    return file
