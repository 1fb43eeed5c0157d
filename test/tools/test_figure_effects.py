#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""scripts/figures: the table of what can affect which step, compared with the sources."""

import ast
import re
import unittest
from itertools import combinations
from pathlib import Path

from datmo_tools.figures.effects import LEAVES, Leaf, can_affect, leaf_of
from datmo_tools.figures.steps import STEPS

ROOT = Path(__file__).resolve().parents[2]
NAMES = {step.name for step in STEPS}
CODE = ("src", "include", "tools", "benchmark")
INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.MULTILINE)
WORD = re.compile(r'"(--[\w-]+|\w+)"')
# Python files that name programs, subcommands, experiments and switches to run them.
RUNNERS = tuple(f"tools/datmo_tools/{folder}/" for folder in ("convert", "evaluate", "experiments", "figures"))
STAGES = "src/ros/stage/"
# Switches of run_bag that start stages in leaves; no include leads there, as it makes stages by their names.
SWITCHES = {
    "--mono": {f"{STAGES}mono_classifier_stage.cpp", f"{STAGES}mono_grid_stage.cpp"},
    "--risk": {f"{STAGES}risk_stage.cpp"},
}
# What a script runs or sources beside it.
SCRIPT = re.compile(r"""(?:repository/scripts|\$\(dirname "\$\{BASH_SOURCE\[0\]\}"\))/(\w[\w.]*)""")
RUN_BY_NAME = tuple(f"tools/datmo_tools/{folder}/" for folder in ("convert", "evaluate", "experiments"))


def name_of(file):
    return file.relative_to(ROOT).as_posix()


def included(file, text):
    """Returns the files of the repository (names) that a C++ file includes."""
    folders = (file.parent, ROOT / "include", ROOT / "tools", ROOT / "src", ROOT / "benchmark")
    found = (next((folder / name for folder in folders if (folder / name).is_file()), None)
             for name in INCLUDE.findall(text))  # fmt: skip
    return {name_of(header.resolve()) for header in found if header}


def imported(text, modules):
    """Returns the same for a Python file; modules: name of a module -> of its file."""
    names = set()
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Import):
            names.update(alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            names.update((node.module, *(f"{node.module}.{alias.name}" for alias in node.names)))
    return {modules[name] for name in names if name in modules}


def runnable(files):
    """Returns a dictionary word -> files that a tool which says the word may run."""
    found = dict(SWITCHES)
    for file in files:
        name = file.parent.name if file.name == "main.py" else re.sub("_main$", "", file.stem)
        if name != file.stem or name_of(file).startswith(RUN_BY_NAME):
            found.setdefault(name, set()).add(name_of(file))
    return found


def uses():
    """Yields (name of a file, names of the files that it uses) for all code."""
    files = [file for folder in CODE for file in sorted((ROOT / folder).rglob("*.*"))
             if file.suffix in (".py", ".h", ".cpp")]  # fmt: skip
    modules = {".".join(file.relative_to(ROOT / "tools").with_suffix("").parts): name_of(file)
               for file in files if file.suffix == ".py"}  # fmt: skip
    by_word = runnable(files)
    for file in files:
        name, text = name_of(file), file.read_text(encoding="utf-8")
        used = imported(text, modules) if file.suffix == ".py" else included(file, text)
        if name.startswith(RUNNERS):
            used = used.union(*(by_word.get(word, ()) for word in WORD.findall(text)))
        yield name, used


USES = dict(uses())


def scripts_run_by(name):
    """Returns the names of a script and of those that it runs or sources, and so on."""
    found, todo = set(), {name}
    while todo:
        found |= todo
        texts = [(ROOT / "scripts" / name).read_text(encoding="utf-8") for name in todo]
        todo = {name for text in texts for name in SCRIPT.findall(text) if (ROOT / "scripts" / name).is_file()} - found
    return found


def other_users(leaf):
    """Returns the files that use a leaf's files, are not stated as its users, and can affect a step
    that the leaf cannot."""
    users = {user for user, used in USES.items() if any(file.startswith(leaf.paths) for file in used)}
    return sorted(user for user in users if not user.startswith(leaf.paths) and user not in leaf.users
                  and any(can_affect(user, name) for name in NAMES.difference(leaf.steps)))  # fmt: skip


class Table(unittest.TestCase):
    def test_a_file_in_no_leaf_affects_every_step(self):
        for name in NAMES:
            self.assertTrue(can_affect("src/tracking/tracker.cpp", name))
            self.assertFalse(can_affect("doc/limits.md", name))
        self.assertTrue(can_affect("src/risk/risk_assessor.cpp", "risk"))
        self.assertFalse(can_affect("src/risk/risk_assessor.cpp", "fusion"))

    def test_steps_are_steps_and_paths_exist(self):
        for leaf in LEAVES:
            self.assertLessEqual(set(leaf.steps), NAMES)
            for path in leaf.paths:
                self.assertTrue(any(ROOT.glob(path + "*")), path)
            for user in leaf.users:
                self.assertTrue((ROOT / user).is_file(), user)

    def test_each_file_is_in_one_leaf_at_most(self):
        for one, other in combinations([path for leaf in LEAVES for path in leaf.paths], 2):
            self.assertFalse(one.startswith(other) or other.startswith(one), (one, other))

    def test_leaves_are_used_only_in_their_steps(self):
        found = {leaf.paths: other_users(leaf) for leaf in LEAVES}
        self.assertEqual({paths: users for paths, users in found.items() if users}, {})

    def test_scripts_that_scripts_figures_runs_affect_every_step(self):
        run = scripts_run_by("figures")
        self.assertLessEqual({"figures", "lib.sh", "setup", "build"}, run)
        self.assertEqual([name for name in run if leaf_of(f"scripts/{name}")], [])
        self.assertLessEqual({"lib.sh", "display.sh"}, scripts_run_by("demo"))

    def test_other_users_are_found(self):
        header = other_users(Leaf(("risk", "speed"), ("include/datmo_fusion/risk/box_contact.h",)))
        self.assertIn("tools/simulator/collision.h", header)
        self.assertNotIn("src/risk/criticality.cpp", header)
        module = other_users(Leaf(("risk",), ("tools/datmo_tools/evaluate/labels.py",)))
        self.assertEqual(module, ["tools/datmo_tools/evaluate/main.py", "tools/datmo_tools/figures/recordings.py"])
        program = other_users(Leaf(("risk",), ("tools/kitti_tracking/kitti_tracking_run_main.cpp",)))
        self.assertEqual(program, ["tools/datmo_tools/figures/recordings.py"])
        converter = other_users(Leaf(("risk",), ("tools/convert/clouds_to_scans_main.cpp",)))
        self.assertEqual(converter, ["tools/datmo_tools/convert/kitti_scans.py"])
        switch = other_users(Leaf(("speed",), (f"{STAGES}risk_stage.cpp",)))
        self.assertEqual(switch, ["tools/datmo_tools/experiments/encounters.py", "tools/datmo_tools/figures/risk.py"])

    def test_switches_lead_to_all_stages_in_leaves(self):
        in_leaves = {name for name in USES if name.startswith(STAGES) and name.endswith("_stage.cpp") and leaf_of(name)}
        self.assertEqual(set().union(*SWITCHES.values()), in_leaves)
        switches = (ROOT / STAGES / "stack_switches.cpp").read_text(encoding="utf-8")
        for switch in SWITCHES:
            self.assertIn(f'{{"{switch[2:]}", &', switches)

    def test_stated_users_are_users(self):
        for leaf in LEAVES:
            for user in leaf.users:
                self.assertTrue(any(file.startswith(leaf.paths) for file in USES[user]), (user, leaf.paths))

    def test_headers_are_listed_with_their_sources(self):
        for name, used in USES.items():
            own = {header for header in used if Path(header).stem == Path(name).stem}
            if name.endswith(".cpp") and leaf_of(name):
                for header in own:
                    self.assertIsNotNone(leaf_of(header), header)
                    self.assertLessEqual(set(leaf_of(header).steps), set(leaf_of(name).steps), name)

    def test_the_core_and_the_stages_affect_the_speed(self):
        for name in USES:
            if name.startswith(("src/", "include/")) and not name.startswith("src/rviz/"):
                self.assertTrue(can_affect(name, "speed"), name)

    def test_modules_of_steps_affect_them(self):
        for step in STEPS:
            for function in (step.jobs, step.figures):
                file = f"tools/{function.__module__.replace('.', '/')}.py"
                self.assertTrue(can_affect(file, step.name), (file, step.name))


if __name__ == "__main__":
    unittest.main()
