# SPDX-License-Identifier: BSD-3-Clause
"""Creates the sections of the yaml and the commands to start with from the measurements."""

import shlex

from datmo_tools.check_bag.camera_checks import pair_offset
from datmo_tools.check_bag.levels import motion_source
from datmo_tools.check_bag.motion_checks import poses_are_better
from datmo_tools.check_bag.roles import is_wheel_joints
from datmo_tools.check_bag.sizing import is_small, settings
from datmo_tools.check_bag.yaml_text import frames_section, mounts_section

# Stages that wait for a stereo camera unless configured to work without one.
STEREO_FUSIONS = "grid_fusion", "object_fusion"


def sections(recording, roles, results, measured):
    """Returns the sections of the yaml, and remarks on them."""
    items, remarks = {}, {}
    frames = frames_section(roles)
    if frames:
        items["frames"] = frames
        remarks["frames"] = ["Names from the recording; all others are those of REP 105."]
    mounts = mounts_section(recording, roles)
    if mounts:
        items["mounts"] = mounts
        remarks["mounts"] = [
            "MEASURE THIS: the recording does not say where these sensors are mounted.",
            "(For an IMU, roll and pitch from gravity are enough.)",
            f"m and rad, from {roles.base_frame} (below the rear axle, x forward, y left).",
        ]
    motion = motion_section(recording, roles, results)
    if motion:
        items["motion"] = motion
    if measured is not None:
        for name, section in settings(measured).items():
            items.setdefault(name, {}).update(section)
        remarks.update(_size_remarks(measured))
    if pair_offset(recording, roles) > 0.0:
        items["stereo_image_proc"] = {"approximate_sync": True}
        remarks["stereo_image_proc"] = ["The stamps of left and right images differ."]
    if not roles.camera_clouds and not roles.right_image:
        for name in STEREO_FUSIONS:
            items.setdefault(name, {})["sources"] = {"stereo": {"use": False}}
            remarks.setdefault(name, ["The recording has no stereo camera."])
    return items, remarks


def motion_section(recording, roles, results):
    """Returns the section motion: the source of the vehicle's motion."""
    source = motion_source(roles, recording)
    section = {} if source == "odometry" else {"source": source}
    if source == "odometry" and poses_are_better(results):
        section["odometry_pose"] = True
    period = _motion_period(recording, roles, source)
    if period is not None and period > 0.2:
        section["hold"] = round(2.5 * period, 1)
    return section


def _motion_period(recording, roles, source):
    name = {"odometry": roles.odometry, "twist": roles.twist, "imu": roles.imu}.get(
        source.split("_")[0]
    )
    return recording.topics[name].period() if name else None


def _size_remarks(measured):
    noise = "not measured, as the vehicle never stands: the default is kept"
    if measured.noise is not None:
        noise = f"{measured.noise:.3f} m, measured while the vehicle stands"
    speed = "not known" if measured.speed is None else f"{measured.speed:.1f} m/s"
    remarks = [
        f"Measured: range {measured.reach:.1f} m, vehicle speed {speed},",
        f"range noise {noise};",
        f"beams return from surfaces up to {measured.free_range:.0f} m (free_range).",
    ]
    result = {"scanner": remarks}
    if is_small(measured):
        result["tracker"] = [
            "A slow vehicle with a short-range scanner is treated as a robot among people, whose",
            "legs its scanner sees. Objects at rest are tracked, too (require_motion: true: not).",
            "Other targets (model cars): config/model_car.yaml shows what depends on their size.",
        ]
    return result


def topic_arguments(roles, recording):
    """Returns arguments such as scan:=/x, for the inputs with another name than the default."""
    source = motion_source(roles, recording)
    names = {("echoes" if roles.scan_is_echoes else "scan"): roles.scan}
    if source == "odometry":
        names["odometry"] = roles.odometry
    if "imu" in source.split("_"):
        names["imu"] = roles.imu
    if "twist" in source.split("_"):
        covariance = recording.topics[roles.twist].type.endswith("CovarianceStamped")
        names["twist_with_covariance" if covariance else "twist"] = roles.twist
    if "wheels" in source.split("_"):
        names["joint_states"] = next(
            name for name in roles.wheels if is_wheel_joints(recording, name)
        )
    names["steering"], names["acceleration"] = roles.steering, roles.acceleration
    if roles.camera_clouds:
        names["points2"] = _named(roles.camera_clouds, "/stereo/points2")
    return {ours: theirs for ours, theirs in names.items() if theirs and theirs != "/" + ours}


def _named(names, usual):
    return usual if usual in names else names[0]


def start_lines(bag, config, roles, recording, level):
    """Returns shell commands that run the stack on the recording: without a master, and live."""
    topics = [f"{ours}:={theirs}" for ours, theirs in topic_arguments(roles, recording).items()]
    topics = [word for word in topics if word != "points2:=/stereo/points2"]
    switch = [level.switch] if level.switch else []
    offline = ["rosrun", "datmo_fusion", "run_bag", str(bag), "result.bag", "--config", str(config)]
    live = ["roslaunch", "datmo_fusion", "replay.launch", f"bag:={bag.resolve()}",
            f"config:={config.resolve()}"]  # fmt: skip
    live += [f"{name[2:].replace('-', '_')}:=true" for name in switch]
    if level.switch and not roles.camera_clouds and roles.right_image:
        live.append(f"stereo_images:={'rectified' if 'rect' in roles.right_image else 'raw'}")
    return [shlex.join([*offline, *switch, *topics]), shlex.join([*live, *topics])]
