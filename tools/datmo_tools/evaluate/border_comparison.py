# SPDX-License-Identifier: BSD-3-Clause
"""Compares a drive's runs without and with road borders: their false and true moving objects."""

from datmo_tools.evaluate.false_tracks import reduction
from datmo_tools.text_table import NO_VALUE, aligned, percent, rounded

# Heading, and the key of the count in score_run's section "thesis".
COUNTS = (
    ("false moving objects", "false_moving_objects_episodes"),
    ("in a scan", "false_moving_objects_frames"),
    ("tracks", "tracks"),
    ("of them false", "false_tracks"),
    ("moving objects", "moving_objects"),
    ("missed", "missed_objects"),
    ("intersections", "intersections"),
    ("found", "intersections_found"),
    ("false", "intersections_false"),
)

# Quantities whose reduction is reported.
REDUCED = ("false_moving_objects_episodes", "false_moving_objects_frames", "false_tracks")


def comparison(without, with_borders):
    """Returns the comparison as a dictionary that JSON can hold; None for what was not measured.

    Both are reports of score_run (dict) on the same drive. An object is tracked in a run if a track
    matched it in at least one frame; it is lost if it is tracked only without borders.
    """
    runs = {"without": without["thesis"], "with": with_borders["thesis"]}
    counts = {
        name: {key: thesis[key] for _, key in COUNTS} for name, thesis in runs.items()
    }  # fmt: skip
    objects = _objects(without, with_borders)
    return {
        **counts,
        "reduction": {
            key: reduction(counts["without"][key], counts["with"][key]) for key in REDUCED
        },
        "tracked_frames": {
            name: sum(item["tracked_frames"][name] for item in objects) for name in runs
        },
        "objects": objects,
        "lost": [item["id"] for item in objects if _only(item, "without", "with")],
        "gained": [item["id"] for item in objects if _only(item, "with", "without")],
    }  # fmt: skip


def comparison_table(result):
    """Returns a comparison() as text."""
    rows = [["", "without borders", "with borders", "fewer, %"]]
    for heading, key in COUNTS:
        cells = [_cell(result[name][key]) for name in ("without", "with")]
        rows.append([heading, *cells, percent(result["reduction"].get(key))])
    frames = result["tracked_frames"]
    rows.append(["tracked frames of these", *map(str, frames.values()), NO_VALUE])
    objects = [["moving object", "frames", "tracked without borders", "with borders"]]
    for item in result["objects"]:
        objects.append([_name(item), str(item["required_frames"]),
                        *map(str, item["tracked_frames"].values())])  # fmt: skip
    names = {item["id"]: _name(item) for item in result["objects"]}
    changes = [
        f"{sort}: {', '.join(names[number] for number in result[sort]) or 'none'}"
        for sort in ("lost", "gained")
    ]
    return "\n\n".join([aligned(rows), aligned(objects), "\n".join(changes)])


def _name(item):
    return f"{item['label']} {item['id']}"


def _objects(without, with_borders):
    by_id = {item["id"]: item for item in with_borders["objects"]}
    return [
        {
            "id": item["id"],
            "label": item["label"],
            "required_frames": item["required_frames"],
            "tracked_frames": {
                "without": item["tracked_frames"],
                "with": by_id[item["id"]]["tracked_frames"] if item["id"] in by_id else 0,
            },
        }
        for item in without["objects"]
    ]


def _only(item, name, other):
    frames = item["tracked_frames"]
    return frames[name] > 0 and frames[other] == 0


def _cell(value):
    if isinstance(value, float):
        return rounded(value, 2)
    return NO_VALUE if value is None else str(value)
