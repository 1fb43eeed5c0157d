# SPDX-License-Identifier: BSD-3-Clause
"""Steps in the file of figures: those on which no change has had an effect since, and the others."""

from typing import NamedTuple

from datmo_tools.errors import InputError
from datmo_tools.figures import results_file
from datmo_tools.figures.commits import CHANGED, changed_files
from datmo_tools.figures.effects import can_affect

# Ends of the files that a sample of the jobs is enough for: C++ code, how it is built, and the reader
# of bags, which all jobs use. Other tools in Python also make the figures from the results of the jobs,
# which a sample does not check, and a scene or a recording concerns some jobs only.
SAMPLED = (".cpp", ".h", ".cmake", "CMakeLists.txt", "tools/datmo_tools/bag_input.py")


class Earlier(NamedTuple):
    """Records of steps (dict, by name), as in the file of figures."""

    unaffected: dict = {}  # whose figures are those of the sources, too
    affected: dict = {}  # that a change since may have affected of which a sample is enough


def earlier_steps(file, source, commit, steps):
    """Returns the Earlier records of steps.

    file (Path): of figures; without a readable one there are no records. source (Path), commit: the
    checkout, and the commit of its figures.
    """
    if commit.endswith(CHANGED) or not file.is_file():
        return Earlier()
    try:
        results = results_file.read(file)
    except InputError as error:
        print(f"{error}; no step in it counts as done")
        return Earlier()
    found = {step.name: results["steps"][step.name] for step in steps if step.name in results["steps"]}
    commits = {results_file.last_commit(record) for record in found.values()}
    changes = {name: changed_files(source, name) for name in commits}
    unaffected, affected = {}, {}
    for name, record in found.items():
        files = changes[results_file.last_commit(record)]
        if files is not None:
            causes = [file for file in files if can_affect(file, name)]
            if not causes:
                unaffected[name] = record
            elif all(file.endswith(SAMPLED) for file in causes):
                affected[name] = record
    return Earlier(unaffected, affected)
