# SPDX-License-Identifier: BSD-3-Clause
"""Formats the page of the campaign: what was done to the stack, and the results."""

from datmo_tools.experiments.campaign_compared import compared
from datmo_tools.experiments.soak import of_nodelets, of_stack
from datmo_tools.text_table import NO_VALUE, percent, rounded

TRACK_FIGURES = ("mota", "misses", "false_positives", "id_switches")
# A pose has recovered when its error is that of the clean drive again, within this (m).
RECOVERED = 0.3
IDS = {True: "yes", False: "no", None: NO_VALUE}
BESIDE = "What Autoware and PX4 promise and test for such faults is [at the end](#beside-autoware-and-px4)."
# Fewer hours of live nodelets than this do not determine a growth.
SOAKED = 0.2


def page(report):
    """Formats the report (dict) as Markdown; parts that were not run are left out."""
    made = f", {report['made']}" if report["made"] else ""
    parts = [["# Reliability", "", f"Written by `scripts/campaign`{made}. {BESIDE}", *_beyond_lines(report["beyond"])]]
    parts += [_fault_lines(report, drive) for drive in report["drives"]]
    for part, lines in (("silent", _silent_lines), ("outages", _outage_lines), ("load", _load_lines),
                        ("soak", _soak_lines), ("mutated", _mutated_lines)):  # fmt: skip
        if report[part]:
            parts.append(lines(report[part]))
    parts.append([compared(report)])
    return "\n\n".join("\n".join(lines) for lines in parts) + "\n"


def _beyond_lines(beyond):
    return ["", "Beyond the bounds of `test/campaign/fault_bounds.yaml`:", "", *(f"- {line}" for line in beyond)] if beyond else []


def _fault_lines(report, drive):
    options = " ".join(("run_bag", *drive["options"]))
    lines = [
        f"## Faults of the inputs: {drive['drive']}",
        "",
        f"The drive through `{options}` with one fault from {report['begin_s']:g} s on (`always`, `mounts`: in all of the drive; run_bag reads the mounts first). Error: of the",
        "position since the first pose; sigma: the pose's own, after the fault began. Recovered: seconds after the fault's end until the position is as accurate as",
        f"without it, within {RECOVERED:g} m; `never`: not before the drive's end. A clock that jumps starts a new map:",
        "errors are since its first pose, and tracks whose time went back have no score. "
        f"{len(drive['runs']) - 1} of the campaign's {drive['of']} faults.",
        "",
        "| fault | poses | largest error [m] | at the end [m] | largest sigma [m] | largest error [sigma] | recovered [s] | MOTA | misses | false positives | id switches |",
        "|---|---|---|---|---|---|---|---|---|---|---|",
    ]
    return lines + [_row(run) for run in drive["runs"]]


def _silent_lines(runs):
    return [
        "## One scanner silent for 3 s, with a stereo camera",
        "",
        "At five times of that drive, by level of fusion. Error: added by the silence, at the first pose after it and the maximum from",
        "0.5 s later on, in m and relative to the distance driven meanwhile. Ids: of moving objects in the camera's view before, during and",
        "after it, how many have a track before and after, and how many of them with the same id.",
        "",
        "| level | from [s] | poses, lists of tracks during it | distance [m] | error after [m] | 0.5 s later [m] | of the distance | seen | tracked | ids kept |",
        "|---|---|---|---|---|---|---|---|---|---|",
        *(_silent_row(run) for run in runs),
    ]


def _silent_row(run):
    if run["error"] is not None:
        return f"| {run['level']} | {run['from_s']:g} | none: {_short(run['error'])} | | | | | | | |"
    settled = run["settled_m"]
    share = None if settled is None else settled / run["distance_m"]
    cells = [run["level"], f"{run['from_s']:g}", f"{run['poses_meanwhile']}, {run['lists_meanwhile']}", f"{run['distance_m']:.1f}",
             rounded(run["first_m"], 2), rounded(settled, 2), f"{percent(share)} %", *(str(run[key]) for key in ("seen", "tracked", "kept"))]  # fmt: skip
    return f"| {' | '.join(cells)} |"


def _outage_lines(outages):
    return [
        "## Nodelets unloaded, process killed",
        "",
        "Live (`outage.test`, `fusion:=recommended risk:=true`), at the computer's pace, while a drive goes on: seconds until the nodelet is loaded",
        "again by its `load_nodelet`, and until there are tracks of a scan that was measured afterward; whether 3 s later the other",
        "car still has its id. After being killed, grid_slam continues in its map (`checkpoint`, [live.md](live.md#after-a-crash)).",
        "",
        "| what | loaded [s] | tracks [s] | id kept |",
        "|---|---|---|---|",
        *(f"| {each['what']} | {each['loaded_s']:.1f} | {each['tracks_s']:.1f} | {IDS[each['id_kept']]} |"
          for each in outages),
    ]  # fmt: skip


def _load_lines(load):
    rows = [(name, load[key]) for name, key in (("nominal", "nominal"), ("load", "load"), ("after it", "after"))]
    before, most, after = load["memory_mib"]
    return [
        "## Load",
        "",
        f"Live (`load.test`, all on one computer, low level and track fusion, borders, risk): {load['load_s']:.0f} s of three times the",
        f"sensors' rates (scans at 37.5 Hz), clouds of 196,608 pixels at 20 Hz and lists of {load['objects']} objects at 37.5 Hz; then the",
        f"process is stopped (SIGSTOP) for {load['still_s']:.0f} s. Latency: from the stamp of a scan to its tracks.",
        "",
        "| | lists of tracks | median [s] | 99 % [s] | max [s] |",
        "|---|---|---|---|---|",
        *(f"| {name} | {row['lists']} | {rounded(row['median_s'], 3)} | {rounded(row['percentile_99_s'], 3)} | "
          f"{rounded(row['worst_s'], 3)} |" for name, row in rows),
        "",
        f"- {load['recovered_s']:.2f} s after the end of both, latency is again within twice the 99th percentile of before",
        f"- memory of the process: {before:.0f} MiB before, {most:.0f} MiB at most, {after:.0f} MiB at the end",
        "",
        "Messages sent and their outcome; every message that is not processed is counted by the stage:",
        "",
        "| stage | sent | received | lost in queues | too old | processed |",
        "|---|---|---|---|---|---|",
        *(f"| {stage['stage']} | {' | '.join(f'{stage[key]:.0f}' for key in ('sent', 'received', 'lost', 'stale', 'processed'))} |"
          for stage in load["stages"]),
        *_live_lines(load["samples"], load["nominal_from_to_s"][1]),
    ]  # fmt: skip


def _soak_lines(soaked):
    stack = of_stack(soaked["samples"])
    return [
        "## Soak",
        "",
        f"`soak_stack`: {stack['hours']:.2f} hours of an endless drive, all levels of fusion, in one process as fast as possible;",
        f"{stack['dropped']} messages dropped, at least {stack['tracks_least']} tracks in the lists of each minute. Growth: of a straight line through",
        "the minutes' samples, once memory holds the maximum number of tiles (`map/max_tiles`: the first half, or half an hour), +- its standard error. Loop closing",
        f"is left out, because it stores the drive ([limits.md](limits.md)). A scan with all processing took {soaked['second_quarter_ms']:.2f} ms of processor time",
        f"in the second quarter of the drive and {soaked['last_quarter_ms']:.2f} ms in the last one (medians; more than {soaked['max_slowing']:g} times as much is a fault).",
        "",
        "| | median | growth per hour of data |",
        "|---|---|---|",
        *(_drift_row(name, stack[key]) for name, key in (
            ("allocated memory [MiB]", "heap_mib"), ("memory of the process [MiB]", "resident_mib"),
            ("a scan with all processing, median of a minute [ms of processor time]", "median_ms"))),
    ]  # fmt: skip


def _live_lines(samples, seconds):
    """Returns the lines on the nodelets before the load: `samples` as written by load.test."""
    if seconds / 3600.0 < SOAKED:
        return []
    live = of_nodelets(samples, seconds)
    return [
        "",
        f"Before it, {live['hours']:.2f} hours at the sensors' rates; growth: as in the soak test below.",
        "",
        "| | median | growth per hour |",
        "|---|---|---|",
        _drift_row("memory of the process [MiB]", live["resident_mib"]),
        _drift_row("scan to tracks [ms]", live["latency_ms"]),
    ]


def _drift_row(name, drift):
    return f"| {name} | {drift['median']:.2f} | {drift['per_hour']:+.3f} +- {drift['error']:.3f} |"


def _row(run):
    if run["error"] is not None:
        return f"| {run['fault']} | none: {_short(run['error'])} | | | | | | | | |"
    pose, tracks = run["pose"], run["tracks"]
    recovered = f"{pose['recovered_s']:.1f}" if pose["recovered"] else "never"
    cells = [run["fault"], str(pose["poses"]), rounded(pose["largest_error_m"], 2),
             rounded(pose["final_error_m"], 2), rounded(pose["largest_sigma_m"], 2), rounded(pose["largest_error_sigmas"], 1), recovered, _cell(tracks["mota"]),
             *(_cell(tracks[key]) for key in TRACK_FIGURES[1:])]  # fmt: skip
    return f"| {' | '.join(cells)} |"


def _short(error):
    """Returns the beginning of an error's text."""
    return error.split("; ")[0].split(" (")[0]


def _cell(value):
    if value is None:
        return NO_VALUE
    return f"{value:.3f}" if isinstance(value, float) else str(value)


def _mutated_lines(mutated):
    refused = sorted(mutated["refused"].items(), key=lambda item: (-item[1], item[0]))
    return [
        "## Mutated messages",
        "",
        f"{mutated['drives']} drives with seeds from {mutated['first_seed']} on, {mutated['messages']} messages of sensors, and",
        f"{mutated['mutated']} copies of these and of those between stages with one to three corrupted fields (NaN, infinity, bounds of the type, other",
        f"lengths, names and stamps), of {len(mutated['mutated_type'])} types, in place of the intact message or with later stamps: at least {percent(mutated['past_stamp_checks'] / mutated['mutated'])} % of them passed the",
        "checks of stamps, so that their content was tried. Each drive ends with 3 s without mutations, in which tracks have to reappear.",
        "",
        f"- faults found: {len(mutated['faults'])}" + "".join(f"\n  - {fault}" for fault in mutated["faults"]),
        f"- slowest message, including all processing that it triggers: {mutated['slowest_s']:.2f} s of processor time ({mutated['slowest_on']}); limit {mutated['max_s']:g} s",
        f"- peak memory: {mutated['peak_memory_mib']:.0f} MiB; limit {mutated['max_memory_mib']:g} MiB",
        "- rejected or warned about, by reason: "
        + ", ".join(f"{reason} {count}" for reason, count in refused),
    ]
