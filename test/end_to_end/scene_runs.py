# SPDX-License-Identifier: BSD-3-Clause
"""Simulated scenes through the stack."""

import os
import subprocess
from pathlib import Path

from evaluated_run import RUN_BAG

ROOT = Path(__file__).resolve().parents[2]
SCENES = ROOT / "rosbag_fixtures" / "scenes"
CONFIG = ROOT / "config" / "demonstrator.yaml"
SIMULATE = os.environ.get("SIMULATE", "simulate")


def simulated(folder, scene, seed=1, *options):
    """Returns the drive's bag (Path), in the folder; options: KEY=VALUE of simulate."""
    recorded = Path(folder) / f"{scene}_{seed}.bag"
    settings = [word for assignment in options for word in ("--set", assignment)]
    subprocess.run(
        [SIMULATE, str(SCENES / f"{scene}.yaml"), str(recorded), "--seed", str(seed), "--quiet",
         *settings],
        check=True,
    )  # fmt: skip
    return recorded


def computed(recorded, *options, config=CONFIG):
    """Returns the bag (Path) that the stack makes of a drive's bag
    with these options of run_bag."""
    result = recorded.with_name(recorded.stem + "".join(options) + ".result.bag")
    subprocess.run(
        [RUN_BAG, str(recorded), str(result), "--config", str(config), "--with-truth", "--quiet",
         *options],
        check=True,
    )  # fmt: skip
    return result
