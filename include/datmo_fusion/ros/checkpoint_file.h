// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

#include "datmo_fusion/slam/grid_slam.h"

namespace datmo {

/// The state of the SLAM, and what must be the same for another process to continue from it.
struct Checkpoint {
  std::string run;                             ///< start of the stack to which it belongs
  std::map<std::string, std::string> options;  ///< by key
  SlamState slam;
  MapEvidence window;  ///< the cells in the map's window
};

/// Writes a file with everything, whose header has a checksum, and the cells as in the file of a
/// map. It appears only when complete. Returns an id by which writePose() refers to it. Throws
/// std::runtime_error.
std::uint32_t writeCheckpoint(const std::string& file, const Checkpoint& checkpoint);

/// Writes a later state of the SLAM in the same map, in a small file beside the one with this id.
void writePose(const std::string& file, std::uint32_t id, const SlamState& slam);

/// Reads a checkpoint with the latest pose written for it. Throws MapFileError: no such file, no
/// permission, another format, truncated, modified, or larger than for a map of `max_cells`.
Checkpoint readCheckpoint(const std::string& file, std::size_t max_cells);

/// Removes a checkpoint and its pose, if there are any.
void removeCheckpoint(const std::string& file);

}  // namespace datmo
