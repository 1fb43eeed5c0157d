# SPDX-License-Identifier: BSD-3-Clause
"""Formats the report of evaluate track_fusion."""

from datmo_tools.evaluate.report import Section
from datmo_tools.evaluate.thesis_tables import PUBLISHED
from datmo_tools.text_table import NO_VALUE, percent, rounded

LISTS = ("lidar", "stereo", "fused")


def sections(result):
    """Returns a list of Section for a score (dict)."""
    parts = [
        _counts(result),
        _passed(result["passed"]),
        _objects(result["objects"]),
        _false(result["false"]),
        _ghosts(result["ghosts"]),
    ]
    if result["without_truth"]:
        left_out = f"{result['without_truth']} lists without truth are left out"
        parts.insert(0, Section(lines=[left_out]))
    return parts


def _counts(result):
    tracks = result["tracks"]
    rows = [["", "lidar", "stereo", "of both"]]
    rows.append(["this run", str(tracks["lidar"]), str(tracks["stereo"]),
                 str(result["passed"]["tracks"])])  # fmt: skip
    rows += [
        [f"thesis, data set {number}", str(item.laser_tracks), str(item.stereo_tracks),
         str(item.parallel_tracks)]
        for number, item in enumerate(PUBLISHED, start=1)
    ]  # fmt: skip
    return Section("Table 3.3: tracks", rows=rows)


def _passed(item):
    judged, pairs = item["judged"], item["pairs"]
    known = pairs["right"] + pairs["wrong"]
    lines = [
        f"Of {item['tracks']} fused tracks of both {judged} are judged; true are (thesis: 98 %)",
        f"  on what moves   {_of(item['true_movers'], judged)}",
        f"  on a road user  {_of(item['true_road_users'], judged)}",
        f"Pairs of tracks on the same road user: {_of(pairs['right'], known)}, "
        f"{pairs['on_nothing']} more with a track on none",
    ]
    lines += [f"  false: {_false_text(false)}" for false in item["false"]]
    lines += [
        f"  wrong: track {wrong['id']} of {_members(wrong['members'])}, which follow objects "
        f"{' and '.join(map(str, wrong['objects']))}, from {wrong['from_s']:.2f} s, "
        f"{wrong['frames']} frames"
        for wrong in pairs["wrong_pairs"]
    ]
    return Section(lines=lines)


def _objects(item):
    soon = item["soon_s"]
    both, visible = item["followed_by_all"], item["visible_to_all"]
    rows = [["true moving objects", "there", "passed, %", f"within {soon:g} s, %", "frames, %"]]
    rows.append(_row("followed by both", both, both))
    rows.append(_row(f"of them for {soon:g} s or more", both["for_that_long"]))
    if visible is None:
        rows.append(["visible to both", *[NO_VALUE] * 4])
    else:
        rows.append(_row("visible to both", visible, visible))
        long = f"of them for {visible['min_seen_s']:g} s or more"
        rows.append(_row(long, visible["for_that_long"]))
    lines = [f"  late or never: {_object_text(late)}" for late in both["late_or_never"]]
    lines += [
        f"  never: {_object_text(never)}"
        + "".join(
            f", {count} with a track of {source}"
            for source, count in never["followed_frames"].items()
        )
        for never in (visible or {"never": []})["never"]
    ]
    return Section(rows=rows, lines=lines)


def _row(name, item, frames=None):
    shares = [percent(item["passed_share"]), percent(item["in_time_share"])]
    of_frames = ""
    if frames is not None:
        of_frames = percent(_ratio(frames["passed_frames"], frames["frames"]))
    return [name, str(item["objects"]), *shares, of_frames]


def _object_text(item):
    text = (
        f"{item['label']} {item['id']} from {item['from_s']:.2f} s to {item['to_s']:.2f} s, "
        f"{item['passed_frames']} of {item['frames']} frames, {item['range_m'][0]:g} to "
        f"{item['range_m'][1]:g} m away"
    )
    if item["delay_s"] is not None:
        text += f", {item['delay_s']:.2f} s late"
    if "tracks" in item:
        text += (
            f", {_members(item['tracks'])} {item['median_distance_m']:g} m apart (at most "
            f"{item['largest_distance_m']:g})"
        )
    return text


def _false(item):
    if not item["views"]:
        text = "False tracks: /tracks/stereo has no views, so none is known to be within them"
        return Section(lines=[text])
    sorts = list(item["fused"]["by_what"])
    rows = [["false tracks", "all", "in view", "visible", "in a list", *sorts]]
    for name in LISTS:
        one = item[name]
        frames = _ratio(one["in_view_frames"], one["frames"])
        rows.append([name, str(one["all"]), str(one["in_view"]), str(one["visible"]),
                     rounded(frames, 3),
                     *(str(one["by_what"][sort]) for sort in sorts)])  # fmt: skip
    lines = [
        f"fewer than the lidar's in view: {percent(item['reduction'])} % of the tracks, "
        f"{percent(item['frames_reduction'])} % in a list",
    ]
    lines += [f"  false: {_false_text(false)}" for false in item["fused"]["tracks"]]
    return Section(rows=rows, lines=lines)


def _false_text(item):
    near = item["nearest"]
    there = "nothing is known there"
    if near is not None:
        state = "moving" if near["moving"] else "standing"
        there = f"{near['distance_m']:g} m from {near['label']} {near['id']} ({state})"
    members = f" of {_members(item['members'])}" if item["members"] else ""
    return (
        f"track {item['id']}{members} from {item['from_s']:.2f} s to {item['to_s']:.2f} s, "
        f"{item['frames_off']} of {item['frames']} frames; at {item['stamp_s']:.2f} s in map "
        f"({item['position_m'][0]:g}, {item['position_m'][1]:g}), {item['range_m']:g} m at "
        f"{item['bearing_deg']:g} deg, {item['speed_mps']:g} m/s, {there}"
    )


def _ghosts(item):
    rows = [["two tracks on one object", "frames", "of", "ghosts", "id switches"]]
    for name in LISTS:
        one = item[name]
        rows.append([name, str(one["ghost_frames"]), str(one["frames"]), str(one["ghosts"]),
                     str(one["id_switches"])])  # fmt: skip
    lines = [
        f"  {one['label']} {one['id']}: ghosts in {one['ghost_frames']} frames, "
        f"{one['id_switches']} id switches"
        for one in item["fused"]["objects"]
    ]
    return Section(rows=rows, lines=lines)


def _of(count, total):
    return f"{percent(_ratio(count, total))} % ({count} of {total})"


def _ratio(count, total):
    return count / total if total else None


def _members(tracks):
    return " and ".join(f"{source} {number}" for source, number in tracks)
