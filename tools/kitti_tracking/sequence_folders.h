// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <string>
#include <vector>

#include "kitti_tracking/evaluated_sequence.h"

namespace datmo::kitti {

/// The names of the `NAME.txt` in a folder. Throws std::runtime_error if there are none.
std::set<std::string> sequencesIn(const std::string& folder);

/// Reads the sequences of two folders, each with one `NAME.txt` per sequence, in order of name.
/// Throws std::runtime_error as the readers do; for a folder that does not exist or has no such
/// file; and for a sequence that is missing in one of the folders (without results: an empty file).
std::vector<Sequence> readSequences(const std::string& labels_folder,
                                    const std::string& results_folder);

}  // namespace datmo::kitti
