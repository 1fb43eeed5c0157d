# SPDX-License-Identifier: BSD-3-Clause
"""A folder of recordings whose batches run by Snakemake with stand-in programs, for the tests of batch."""

import contextlib
import io
import json
import tempfile
import unittest
from pathlib import Path

from datmo_tools.batch.main import find_snakemake, main
from datmo_tools.errors import InputError

RUN = {
    "format": 1, "start_s": 100.0, "duration_s": 3.0, "wall_s": 1.0, "processor_s": 1.0, "scans": 30,
    "has_truth": True, "distance_m": 12.0, "tracks": 2, "silences": [], "conditions": [],
    "pose": {"longest_gap_s": 0.1, "longest_gap_from_s": 0.0, "first_s": 0.0,
             "widest_sigma_m": 0.1, "widest_sigma_at_s": 1.0},
    "dropped": [{"stage": "tracker", "reason": "old", "count": 2, "max_from_s": 1.0, "max_count": 2}],
}  # fmt: skip
SCORE = {
    "start_s": 100.5, "identity": {}, "hota": {}, "errors": {}, "pose": None,
    "clear_mot": {"mota": 0.8, "misses": 1, "false_positives": 1, "id_switches": 0, "required": 10},
    "series": {"time_s": [0.0, 0.5, 1.0, 1.5], "missed": [0, 1, 0, 0], "false": [0, 0, 0, 1]},
}  # fmt: skip

# Notes each start, and does to itself or its parent process what the recording says.
RUN_BAG = """\
#!/bin/sh
here=$(dirname "$0")
echo "$(basename "$1")" >> "$here/starts"
echo "$@" > "$here/words"
case $(cat "$1") in
  broken) echo "$1: is not a bag" >&2; exit 1 ;;
  kills_itself) kill -9 $$ ;;
  kills_once) if [ ! -e "$here/killed" ]; then touch "$here/killed"; kill -9 $$; fi ;;
  kills_snakemake)
    if [ ! -e "$here/killed" ]; then
      touch "$here/killed"
      parent=$PPID
      until tr '\\0' ' ' < /proc/$parent/cmdline | grep -q -- --snakefile; do
        parent=$(sed -n 's/^PPid:.//p' /proc/$parent/status)
      done
      kill -9 $parent
      exit 1
    fi ;;
  full) cat "$1" > /dev/full || exit 1 ;;
  full_in_german)
    case $LC_ALL in C|POSIX) cat "$1" > /dev/full ;; *) echo "cat: Kein Platz" >&2; false ;; esac || exit 1 ;;
  cannot_write) echo "$1 to $2: $2: cannot be written (Error seeking)" >&2; exit 1 ;;
esac
cp "$1" "$2"
cp "$here/run.json" "$6"
"""
SCORE_RUN = """\
#!/bin/sh
cp "$(dirname "$0")/score.json" "$3"
"""


def why_not():
    """Returns why Snakemake cannot be used; empty if it can."""
    try:
        find_snakemake()
    except InputError as error:
        return f"skipped: {error}"
    return ""


@unittest.skipIf(why_not(), why_not())
class BatchCase(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.drives = self.folder / "some drives"
        self.drives.mkdir()
        self.programs = self.folder / "lib" / "datmo_fusion"
        self.programs.mkdir(parents=True)
        for name, text in (("run_bag", RUN_BAG), ("score_run", SCORE_RUN),
                           ("check_configuration", "#!/bin/sh\n")):  # fmt: skip
            (self.programs / name).write_text(text)
            (self.programs / name).chmod(0o755)
        (self.programs / "run.json").write_text(json.dumps(RUN))
        (self.programs / "score.json").write_text(json.dumps(SCORE))
        (self.folder / "sensors.yaml").touch()

    def record(self, **drives):
        """Writes recordings with these names; the content is what each
        of them does to the program."""
        for name, content in drives.items():
            (self.drives / f"{name}.bag").write_text(content)

    def batch(self, *words):
        """Returns exit code, output, and report; the starts of run_bag are counted anew."""
        (self.programs / "starts").write_text("")
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            code = main([str(self.drives), "--config", str(self.folder / "sensors.yaml"),
                         "--programs", str(self.programs), "--jobs", "1", *words])  # fmt: skip
        report = self.drives / "batch" / "batch.json"
        log = self.drives / "batch" / "snakemake.log"
        said = out.getvalue() + err.getvalue() + (log.read_text() if log.exists() else "")
        return code, said, json.loads(report.read_text()) if report.exists() else None

    def starts(self):
        return sorted((self.programs / "starts").read_text().split())
