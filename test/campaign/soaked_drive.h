// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "run_bag/graph_runner.h"
#include "world.h"

namespace datmo::campaign {

/// Resources and results of one minute of a drive.
struct SoakSample {
  double hours = 0.0;         ///< of data, at its end
  double heap_mib = 0.0;      ///< allocated; the process has more, in fragments and caches
  double resident_mib = 0.0;  ///< of the process
  double median_ms = 0.0;     ///< of CPU time, for a scan and all that follows from it
  double percentile_99_ms = 0.0;
  std::size_t track_lists = 0;
  std::size_t tracks = 0;
  std::uint64_t dropped = 0;  ///< since the start, by all stages
};

/// An endless drive through all levels of the stack, as fast as possible: an endless World, scans
/// and odometry at 16 Hz and a stereo cloud with every second scan.
class SoakedDrive {
 public:
  /// `max_tiles`: as map/max_tiles of the SLAM, whose map fills memory until the vehicle has left
  /// that many behind; 0: as in the sensor set.
  SoakedDrive(const std::string& config, int max_tiles);

  /// Continues the drive for a minute of data.
  SoakSample nextMinute();

  /// Returns what the stages dropped on their own account, or which output is missing; empty:
  /// nothing is wrong.
  std::vector<std::string> faults() const;

 private:
  void step(bool with_cloud);
  template <typename Message>
  void send(const std::string& topic, const Message& message);
  void take(const Publications& published);

  GraphRunner runner_;
  World world_{World::Length::kEndless};
  std::uint64_t steps_ = 0;
  SoakSample sample_;
  std::vector<double> milliseconds_;  ///< CPU time of the scans of this minute
  std::uint64_t minutes_without_tracks_ = 0;
};

}  // namespace datmo::campaign
