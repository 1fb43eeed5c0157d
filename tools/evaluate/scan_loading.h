// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "evaluate/score_options.h"

#include "datmo_fusion/common/scan.h"

namespace datmo::evaluation {

/// The scans of a recording, by rising stamp, in the frame of the vehicle (base_link) by
/// /tf_static. Of several echoes of a beam the nearest. Throws std::runtime_error that names file,
/// topic and stamp: as loadTruth(), no scans, a scan that cannot be read, no mount of the scanner.
std::vector<Scan> loadScans(const std::string& file, const TopicOptions& topics);

}  // namespace datmo::evaluation
