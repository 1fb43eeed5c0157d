// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "evaluate/score_options.h"

#include "datmo_fusion/common/scan.h"

namespace datmo::evaluation {

/// Loads the scans of a recording, in order of stamp, in the frame of the vehicle (base_link) by
/// /tf_static. Of several echoes of a beam, the nearest is used. Throws std::runtime_error that
/// names file, topic and stamp: as loadTruth(), and if there are no scans, a scan cannot be read,
/// or the mount of the scanner is missing.
std::vector<Scan> loadScans(const std::string& file, const TopicOptions& topics);

}  // namespace datmo::evaluation
