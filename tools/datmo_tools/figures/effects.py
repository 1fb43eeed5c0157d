# SPDX-License-Identifier: BSD-3-Clause
"""Which steps' figures the change of a file can affect: those of the leaf that lists it, and all of
them if none does. test/tools/test_figure_effects.py compares the leaves with the sources."""

from typing import NamedTuple


class Leaf(NamedTuple):
    """Files that are used by these steps alone."""

    steps: tuple  # names; none: no figure depends on the files
    paths: tuple  # prefixes of their names below the root of the sources
    # Files outside that include, import or name these, but run them in none of the other steps.
    users: tuple = ()


def _under(folder, *names):
    return tuple(f"tools/datmo_tools/{folder}/{name}" for name in names)


def _parts(room, *names):
    """The sources and headers of parts of a room."""
    return tuple(f"{base}/{room}/{name}." for base in ("src", "include/datmo_fusion") for name in names)


_EVALUATE = "tools/datmo_tools/evaluate/main.py"  # lists all subcommands
_CAMERAS, _MEASUREMENTS, _MONO, _RECORDINGS, _STEPS = _under(
    "figures", "cameras.py", "measurements.py", "mono.py", "recordings.py", "steps.py")  # fmt: skip

_NOT_RUN = (
    Leaf((), ("README.md", "CHANGELOG.rst", "LICENSE", "doc/", "test/", "migration/", "meshes/",
              "Dockerfile", ".ci/", ".github/", ".clang-format", ".clang-tidy", ".dockerignore",
              ".gitignore", "rviz_plugins.xml", "config/perception.rviz", "config/risk.rviz",
              "config/foxglove_layout.json", "src/rviz/")),
    Leaf((), tuple(f"scripts/{name}" for name in (
        "batch", "benchmark", "campaign", "check_install", "check_layers", "check_sizes",
        "compare_fusion", "data_sets", "demo", "display.sh", "encounters", "fuzz", "gaps",
        "loop_closing", "machines", "meshes", "pole_camera", "prior_map", "risk_demo", "robustness",
        "run_readme", "slam_benchmark", "test", "thread_sanitizer", "tidy"))),
    # Which steps run, and how figures are stored and look. What a step measures is in the files that
    # its row in steps.py names.
    Leaf((), _under("figures", "commits.py", "earlier.py", "effects.py", "main.py", "pass_of_steps.py",
                    "render.py", "results_file.py", "sample.py", "steps.py", "fusion_results.",
                    "map_results.", "mono_results.", "readme_table.", "results.md.jinja",
                    "risk_results.", "wrong_classes_results."),
         # Which say "figures", and mean those of a step.
         (*_under("experiments", "compare_fusion.py"), *_under("figures", "cameras.py", "data_sets.py"))),
    Leaf((), tuple(f"tools/datmo_tools/{name}.py" for name in (
        "camera_topics", "convert/merge_bags", "image_files", "open_rviz", "play_images",
        "publish_tracks_as", "rviz_view", "track_bridge", "usb_camera"))),
    Leaf((), ("tools/datmo_tools/batch/",
              *_under("experiments", "campaign", "carried_drive.py", "fault_bounds.py", "gap_score.py",
                      "gaps.py", "kept_ids.py", "line_faults.py", "lossy_network.py", "machines.py",
                      "machines_run.py", "map_coverage.py", "namespaced_roslaunch.py", "play_now.py",
                      "pole_camera.py", "pole_camera_bag.py", "prior_map.py", "record_now.py", "soak.py"))),
    Leaf((), _under("evaluate", "calibrate_", "compare_borders.py", "covariance_", "draw_borders.py",
                    "border_images.py", "border_recordings.py", "border_sheets.py", "border_views.py",
                    "source_"), (_EVALUATE,)),
)  # fmt: skip

_SPEED = (
    # The other steps run the stages without nodelets and launch files.
    Leaf(("speed",), ("benchmark/", "src/nodelets/", "launch/", "tools/launch/", "config/diagnostics/",
                      "tools/datmo_tools/launch_arguments.py", "tools/datmo_tools/registrations.py",
                      "tools/datmo_tools/keep_registrations.py")),
    Leaf(("speed",), _under("experiments", "process_usage.py", "speed_"), (_MEASUREMENTS,)),
    # Devices, which only nodelets use.
    Leaf(("speed",), ("src/device/", "include/datmo_fusion/device/",
                      *_parts("ros", "convert/device_conversion", "device_diagnostics", "device_options",
                             "device_output", "v2x_wire")),
         ("tools/parameter_tables.cpp",)),  # lists options
)  # fmt: skip

_RISK = (
    # Without box_contact, host_motion and risk, which others use.
    Leaf(("risk", "speed"),
         ("src/risk/contact_futures.", "src/risk/object_future_options.",
          *_parts("risk", "criticality", "host_futures", "object_futures", "object_start", "random_draws",
                 "risk_assessor", "rule_methods", "standing_points", "warning_level"),
          *_parts("ros/stage", "host_input", "risk_stage")),
         ("src/ros/display/track_predictions.cpp",)),  # draws
    Leaf(("risk",), ("tools/run_bag/replay_risks_main.cpp", "tools/simulator/true_risks_main.cpp",
                     "tools/simulator/true_tracks.")),
    Leaf(("risk",), (*_under("experiments", "encounters.py", "encounter_scenes.py", "random_encounters.py"),
                     *_under("evaluate", "risk.py", "risk_drives.py", "risk_scores.py"),
                     *_under("figures", "risk.py")), (_EVALUATE, _STEPS)),
)  # fmt: skip

_CAMERA = (
    Leaf(("mono", "speed"),
         ("src/vision/ground_view.", "src/vision/sight_line.",
          *_parts("vision", "class_reliability", "detection_association", "dnn_detector", "hog_detector",
                 "mono_classifier", "mono_grid", "network_decoding", "road_color"),
          *_parts("ros/stage", "mono_classifier_stage", "mono_grid_stage"))),
    Leaf(("mono", "wrong_classes"),
         (*_under("evaluate", "classes.py", "track_classes.py"), *_under("figures", "class_figures.py")),
         # The latter's "classes" are score_run's.
         (_EVALUATE, *_under("experiments", "fusion_comparison.py"))),
    Leaf(("mono", "speed"), _under("figures", "network.py"), (_MEASUREMENTS, _MONO)),
    Leaf(("mono",), (_MONO,), (_STEPS,)),
    Leaf(("wrong_classes",), _under("figures", "wrong_classes.py"), (_STEPS,)),
    Leaf(("fusion",), _under("experiments", "camera_view.py", "compare_fusion.py", "fusion_comparison.py",
                             "fusion_plot.py"), (_CAMERAS,)),
    Leaf(("fusion", "grids", "stereo_grids"), (_CAMERAS,), (_STEPS,)),
)  # fmt: skip

# With programs and scores of their own.
_OTHERS = (
    Leaf(("kitti_tracking",), ("tools/kitti_tracking/", "config/kitti_tracking/"), (_RECORDINGS,)),
    Leaf(("model_cars",), _under("convert", "mocap_"), (_RECORDINGS,)),
    Leaf(("people",), ("tools/check_bag/", "tools/datmo_tools/check_bag/",
                       *_under("evaluate", "labels.py", "labeled_positions.py")), (_EVALUATE, _RECORDINGS)),
    Leaf(("slam",), (*_under("convert", "carmen_"), *_under("evaluate", "relations.py", "slam.py"),
                     *_under("experiments", "loop_closing.py", "slam_benchmark.py")),
         (_EVALUATE, _RECORDINGS, _STEPS)),
    Leaf(("data_sets",), _under("figures", "data_sets.py"), (_STEPS,)),
    Leaf(("maps",), (*_under("evaluate", "changes.py", "map_scores.py", "maps.py"), *_under("figures", "maps.py")),
         (_EVALUATE, _STEPS)),
    Leaf(("robustness",), _under("experiments", "robustness.py", "robustness_summary.py"), (_MEASUREMENTS, _STEPS)),
    Leaf(("operating_curve",), _under("evaluate", "operating_curve.py"), (_EVALUATE, _MEASUREMENTS, _STEPS)),
    Leaf(("robustness", "operating_curve", "speed"), (_MEASUREMENTS,), (_STEPS,)),
)  # fmt: skip

LEAVES = (*_NOT_RUN, *_SPEED, *_RISK, *_CAMERA, *_OTHERS)


def leaf_of(path):
    """Returns the leaf that lists a file; None without any."""
    return next((leaf for leaf in LEAVES if path.startswith(leaf.paths)), None)


def can_affect(path, step):
    """Returns whether the change of a file can affect the figures of a step (its name)."""
    leaf = leaf_of(path)
    return leaf is None or step in leaf.steps


def without_effect():
    """Returns the prefixes of all files on which no figure depends."""
    return [path for leaf in LEAVES if not leaf.steps for path in leaf.paths]
