# SPDX-License-Identifier: BSD-3-Clause
"""Messages as they were before objects had class_probabilities, for tests."""

import re
from pathlib import Path

from genpy.dynamic import generate_dynamic

ROOT = Path(__file__).resolve().parents[2]
RULE = ROOT / "migration" / "object_class_probabilities.bmr"
OBJECT = "datmo_fusion/Object"


def old_types(kind):
    """Returns the classes, by type, of a message that contains objects (its class) and its parts."""
    old, _, _ = _old_definition().partition("=" * 80)
    sections = re.split("(?m)^={80}\\n", kind._full_text)  # pylint: disable=protected-access
    texts = [
        f"MSG: {OBJECT}\n{old}" if section.startswith(f"MSG: {OBJECT}\n") else section
        for section in sections
    ]
    return generate_dynamic(kind._type, ("=" * 80 + "\n").join(texts))


def old_checksum():
    """Returns the checksum of the objects that the rule converts, by its definition of them."""
    return generate_dynamic(OBJECT, _old_definition())[OBJECT]._md5sum


def _old_definition():
    names = {"MessageUpdateRule": object}  # rosbag's
    exec(RULE.read_text(encoding="utf-8"), names)  # pylint: disable=exec-used
    return names["OLD_DEFINITION"]
