// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include "simulator/scene.h"

namespace datmo::simulator {

/// Called with the simulated time so far, s; returns false to abort.
using Progress = std::function<bool(double)>;

/// Runs the scene and writes the measurements of its sensors and the ground truth to a bag: `/scan`
/// or `/echoes`, `/stereo/...` if there is a stereo camera, `/odometry`, `/steering` and
/// `/acceleration` on demand, `/tf`, `/tf_static`, `/ground_truth/...` (rosbag_fixtures/README.md).
/// The same scene gives the same bytes. The clock starts at 1000 s of ROS time; messages are
/// recorded at their stamps, scans when their last beam is measured, points of the stereo camera
/// after its latency.
///
/// Returns false, and leaves no bag, if `progress` aborts it. Throws std::runtime_error that names
/// the file if it cannot be written.
bool writeSimulationBag(const Scene& scene, const std::string& file, const Progress& progress);

}  // namespace datmo::simulator
