#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""scripts/run_readme on small made-up pages."""

import subprocess
import tempfile
import unittest
from pathlib import Path

SCRIPT = Path(__file__).resolve().parents[2] / "scripts" / "run_readme"


def block(commands, needs=""):
    """Returns a block of bash, with its mark if it needs something."""
    return (f"<!-- needs: {needs} -->\n" if needs else "") + f"```bash\n{commands}\n```\n"


class RunReadme(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)
        self.devel = self.folder / "space"
        self.devel.mkdir()
        (self.devel / "setup.bash").write_text("export SOURCED=yes\n")

    def run_on(self, *texts, options=()):
        """Returns (exit code, output) for pages with these texts."""
        pages = []
        for index, text in enumerate(texts):
            pages.append(self.folder / f"page{index}.md")
            pages[-1].write_text(text)
        command = [str(SCRIPT), "--devel", str(self.devel), *options, *map(str, pages)]
        done = subprocess.run(
            command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False
        )
        return done.returncode, done.stdout.decode()

    def test_blocks_of_a_page_share_a_shell_and_a_folder(self):
        code, output = self.run_on(
            block("source devel/setup.bash\necho 1 >made")
            + block("test $SOURCED = yes\ntest -f made")
        )
        self.assertEqual(code, 0, output)
        self.assertIn("1 pages, 2 blocks run, 0 left out by their marks, 0 pages failed", output)

    def test_each_page_has_a_shell_and_a_folder_of_its_own(self):
        code, output = self.run_on(
            block("A=1; touch made"), block('test -z "$A"\ntest ! -e made')
        )
        self.assertEqual(code, 0, output)

    def test_the_tree_of_the_sources_is_there(self):
        code, output = self.run_on(
            block("test -f config/demonstrator.yaml; test -d rosbag_fixtures/scenes")
        )
        self.assertEqual(code, 0, output)

    def test_an_installed_tree_has_its_own_config_and_takes_the_place_of_devel(self):
        share = self.folder / "prefix" / "share" / "datmo_fusion"
        (share / "config").mkdir(parents=True)
        (share / "config" / "installed.yaml").write_text("")
        (self.folder / "prefix" / "setup.bash").write_text("export FROM=prefix\n")
        code, output = self.run_on(
            block("source devel/setup.bash; test $FROM = prefix; test -f config/installed.yaml"),
            options=["--install-prefix", str(self.folder / "prefix")],
        )
        self.assertEqual(code, 0, output)

    def test_a_block_that_fails_is_named_and_ends_its_page_only(self):
        code, output = self.run_on(
            block("true") + "\n" + block("false\ntouch /nowhere/x"), block("true")
        )
        self.assertEqual(code, 1, output)
        self.assertIn("page0.md:5: FAILED: exit code 1", output)
        self.assertIn("page1.md: ok, 1 blocks run", output)
        self.assertNotIn("/nowhere", output)

    def test_error_output_of_a_program_is_a_failure_too(self):
        code, output = self.run_on(block("echo 'a'; echo '[FATAL] no parameters'"))
        self.assertEqual(code, 1, output)
        self.assertIn("page0.md:1: FAILED: said: [FATAL] no parameters", output)

    def test_a_page_that_does_not_end_is_stopped(self):
        endless = block("read -r line <> <(:)")
        code, output = self.run_on(endless, options=["--timeout", "0.3"])
        self.assertEqual(code, 1, output)
        self.assertIn("not at its end after 0.3 s", output)

    def test_marked_blocks_are_left_out_and_counted(self):
        code, output = self.run_on(block("false", "hours") + block("false", "robot"))
        self.assertEqual(code, 0, output)
        self.assertIn("0 blocks run, left out: 1 hours, 1 robot", output)
        self.assertIn("  1 hours: takes more than a few minutes", output)

    def test_roslaunch_checks_the_arguments_of_blocks_that_need_sensors(self):
        code, output = self.run_on(
            block('roslaunch() { echo "$@" >said; }')
            + block("false\nroslaunch a b.launch config:=/path/to/x.yaml y:=/path/to/z", "robot")
            + block('test "$(cat said)" = "--nodes a b.launch config:=config/demonstrator.yaml y:=$PWD/example.yaml"')
        )
        self.assertEqual(code, 0, output)
        self.assertIn("3 blocks run", output)

    def test_roslaunch_is_checked_behind_an_environment_and_over_several_lines(self):
        code, output = self.run_on(
            block('roslaunch() { echo "$@" >>said; }')
            + "```xml\n<launch>\n  <machine name='a' />\n</launch>\n```\n"
            + block("false\n/home/car/env.sh roslaunch a b.launch \\\n  machines:=/home/car/m.launch \\\n  x:=1\n", "robot")
            + block('test "$(cat said)" = "--nodes a b.launch machines:=$PWD/machines.launch x:=1"\ngrep -q "name=\'a\'" machines.launch')
        )
        self.assertEqual(code, 0, output)
        self.assertIn("3 blocks run", output)

    def test_marked_blocks_run_when_asked_for(self):
        code, output = self.run_on(block("false", "hours"), options=["--with", "hours"])
        self.assertEqual(code, 1, output)

    def test_downloads_run_if_all_their_files_exist(self):
        data = self.folder / "data" / "below"
        data.mkdir(parents=True)
        (data / "log.txt").write_text("")
        page = block("test -f log.txt", "download log.txt")
        more = block("false", "download log.txt other.txt")
        code, output = self.run_on(page + more, options=["--data", str(data.parent)])
        self.assertEqual(code, 0, output)
        self.assertIn("1 blocks run, left out: 1 download", output)

    def test_an_unknown_mark_is_a_failure(self):
        code, output = self.run_on(block("true", "luck"))
        self.assertEqual(code, 1, output)
        self.assertIn("page0.md: FAILED: line 1: needs 'luck'", output)

    def test_a_missing_environment_is_reported(self):
        (self.devel / "setup.bash").unlink()
        code, output = self.run_on(block("true"))
        self.assertEqual(code, 1, output)
        self.assertIn("no setup.bash in", output)


if __name__ == "__main__":
    unittest.main()
