# SPDX-License-Identifier: BSD-3-Clause
"""A run's score, as evaluate reports it."""

import json
import os
import tempfile
from pathlib import Path

from datmo_tools.evaluate.main import main

RUN_BAG = os.environ.get("RUN_BAG", "run_bag")
SCORE_RUN = os.environ.get("SCORE_RUN", "score_run")


def evaluated(run, truth, settings=(), attainable=None):
    """The score of the bag `run` against the bag `truth`; evaluate prints its table.

    settings: KEY=VALUE of score_run. attainable: the drive's bag, for the least delays that its scans allow.
    """
    words = [word for assignment in settings for word in ("--set", assignment)]
    if attainable:
        words += ["--attainable", str(attainable)]
    with tempfile.TemporaryDirectory() as folder:
        code = main(["tracks", str(run), "--truth", str(truth), "--out", folder, *words], SCORE_RUN)
        if code != 0:
            raise RuntimeError(f"evaluate ended with {code}")
        return json.loads((Path(folder) / "tracks.json").read_text(encoding="utf-8"))["runs"][0]
