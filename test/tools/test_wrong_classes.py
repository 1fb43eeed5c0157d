#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""scripts/figures: the step of wrong classes."""

import unittest

from datmo_tools.figures import wrong_classes


class WrongClasses(unittest.TestCase):
    def test_the_stated_share_is_wrong_half_of_it_in_each_way(self):
        self.assertEqual(
            wrong_classes.confusion(0.5),
            "mono/confusion=[0.5, 0.25, 0.25, 0.25, 0.5, 0.25, 0.25, 0.25, 0.5]")  # fmt: skip

    def test_by_range_all_true_classes_count_together(self):
        right = {"vehicle": {"0 to 10 m": [8, 10], "10 to 20 m": [0, 0]},
                 "cyclist": {"0 to 10 m": [1, 2], "10 to 20 m": [0, 0]}}  # fmt: skip
        self.assertEqual(wrong_classes.right_by_range(right), {"0 to 10 m": 0.75, "10 to 20 m": None})


if __name__ == "__main__":
    unittest.main()
