# SPDX-License-Identifier: BSD-3-Clause
"""Steps in the file of figures on which no change has had an effect since they were measured."""

from datmo_tools.errors import InputError
from datmo_tools.figures import results_file
from datmo_tools.figures.commits import CHANGED, changed_files
from datmo_tools.figures.effects import can_affect


def unaffected(file, source, commit, steps):
    """Returns the records (dict, by name) of the steps whose figures are those of the sources, too.

    file (Path): of figures; without a readable one there are no records. source (Path), commit: the
    checkout, and the commit of its figures.
    """
    if commit.endswith(CHANGED) or not file.is_file():
        return {}
    try:
        results = results_file.read(file)
    except InputError as error:
        print(f"{error}; no step in it counts as done")
        return {}
    found = {step.name: results["steps"][step.name] for step in steps if step.name in results["steps"]}
    changes = {name: changed_files(source, name)
               for name in {record["commit"] for record in found.values()}}  # fmt: skip
    return {name: record for name, record in found.items()
            if _has_no_effect(changes[record["commit"]], name)}  # fmt: skip


def _has_no_effect(files, step):
    """files: that have changed; None if that is not known."""
    return files is not None and not any(can_affect(file, step) for file in files)
