#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Reading of command blocks: marks, fences in lists, and blocks that nobody would run."""

import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "documents"))

from command_blocks import PageError, blocks_of  # noqa: E402


class Blocks(unittest.TestCase):
    def test_of_every_language_in_order_with_their_lines(self):
        blocks = blocks_of("# A\n\n```bash\nls\nls -l\n```\ntext\n```yaml\na: 1\n```\n")
        self.assertEqual([(block.line, block.language, block.text) for block in blocks],
                         [(3, "bash", "ls\nls -l\n"), (8, "yaml", "a: 1\n")])

    def test_in_a_list_loses_the_indentation_of_its_fence(self):
        block, = blocks_of("1. do\n\n   ```bash\n   for i in 1; do\n     ls\n   done\n   ```\n")
        self.assertEqual(block.text, "for i in 1; do\n  ls\ndone\n")

    def test_without_a_mark_need_nothing(self):
        block, = blocks_of("```bash\nls\n```\n")
        self.assertEqual((block.needs, block.files), ("", []))

    def test_have_the_mark_in_the_line_before(self):
        block, = blocks_of("<!-- needs: display -->\n```bash\nrviz\n```\n")
        self.assertEqual(block.needs, "display")

    def test_of_a_download_name_its_files(self):
        block, = blocks_of("<!-- needs: download a.bz2 b -->\n```bash\nls\n```\n")
        self.assertEqual((block.needs, block.files), ("download", ["a.bz2", "b"]))

    def test_other_comments_are_no_marks(self):
        block, = blocks_of("<!-- made by hand -->\n```bash\nls\n```\n")
        self.assertEqual(block.needs, "")


class BadPages(unittest.TestCase):
    def expect(self, text, message):
        with self.assertRaises(PageError) as caught:
            blocks_of(text)
        self.assertIn(message, str(caught.exception))

    def test_unknown_mark(self):
        text = "<!-- needs: luck -->\n```bash\nls\n```\n"
        self.expect(text, "line 1: needs 'luck': expected one of build")

    def test_mark_without_a_word(self):
        self.expect("<!-- needs: -->\n```bash\nls\n```\n", "line 1: needs ''")

    def test_files_without_a_download(self):
        text = "<!-- needs: hours a.bag -->\n```bash\nls\n```\n"
        self.expect(text, "only a download names files")

    def test_mark_before_text(self):
        text = "<!-- needs: hours -->\ntext\n```bash\nls\n```\n"
        self.expect(text, "line 1: the mark is not followed")

    def test_mark_before_another_language(self):
        text = "<!-- needs: hours -->\n```yaml\na: 1\n```\n"
        self.expect(text, "line 1: the mark is not followed")

    def test_mark_at_the_end(self):
        self.expect("text\n<!-- needs: hours -->\n", "line 2: the mark is not followed")

    def test_block_without_an_end(self):
        self.expect("```bash\nls\n", "line 1: the block does not end")

    def test_command_in_an_indented_block(self):
        self.expect("text\n\n    rosrun datmo_fusion simulate a b\n", "line 3: a command outside")


if __name__ == "__main__":
    unittest.main()
