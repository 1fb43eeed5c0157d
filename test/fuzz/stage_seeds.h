// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "fuzzed_drive.h"

namespace datmo::fuzz {

/// A seed of the target `stages`.
struct StageSeed {
  std::string name;
  FuzzedDrive drive;
};

/// A short drive for each of the campaign's graphs: what its sensors send, and then the last
/// messages between its stages once more, with later stamps, unless an earlier seed has them.
std::vector<StageSeed> stageSeeds();

}  // namespace datmo::fuzz
