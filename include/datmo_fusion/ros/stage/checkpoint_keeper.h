// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/ros/checkpoint_file.h"
#include "datmo_fusion/ros/stage/newest_worker.h"
#include "datmo_fusion/ros/stage/stage_monitor.h"

namespace datmo {

struct CheckpointOptions {
  std::string file;  ///< empty: none
  std::string run;
  double interval = 2.0;  ///< s
  double max_age = 10.0;  ///< s

  void visit(OptionVisitor& visitor);
};

/// Keeps the state of the SLAM in a file, written in a thread of its own, so that the SLAM can
/// continue in its map after its process was killed; and reads what an earlier process has written
/// there. The map is written periodically, the pose after each scan: the time for which it is not
/// known is the outage alone.
///
/// Nothing here throws for a file that cannot be read or written: that is reported to the monitor,
/// and everything else continues.
class CheckpointKeeper {
 public:
  /// Reads the file. `stage_options`: values that must be the same to continue, by key;
  /// `max_cells`: size of the map's window. `monitor` must outlive the keeper.
  CheckpointKeeper(const Checked<CheckpointOptions>& options,
                   std::map<std::string, std::string> stage_options, std::size_t max_cells,
                   StageMonitor& monitor);

  /// Returns the checkpoint from which to continue with the first scan, which has this stamp; none
  /// if there is none, or it does not belong to this run or configuration, or is too old, or is
  /// newer than the scan (a bag that was started again).
  std::optional<Checkpoint> takeAt(Stamp first_scan);

  /// Starts to write the state after a scan, if the vehicle is located; not while the last one is
  /// being written.
  void keep(const GridSlam& slam);

  /// Writes map and pose, if the vehicle is located, and returns when that is done.
  void finish(const GridSlam& slam);

  /// Forgets what was read and written, and removes it, since the clock has jumped: by the new
  /// clock, it may look recent.
  void reset();

 private:
  struct Job {
    SlamState slam;
    std::optional<MapEvidence> window;  ///< none: only the pose is written
    std::uint32_t id = 0;               ///< of the checkpoint with the map of the pose
  };
  struct Result {
    std::uint32_t id = 0;
    std::string error;  ///< empty: none
  };

  void read(std::size_t max_cells);
  /// Says why not to continue from this checkpoint; empty: nothing speaks against it.
  std::string refusalOf(const Checkpoint& checkpoint, Stamp first_scan) const;
  std::string differenceOf(const Checkpoint& checkpoint) const;
  Result write(const Job& job) const;
  /// Takes the results of the jobs that are done.
  void takeResults();
  bool isMapDue(const SlamState& state) const;
  void start(SlamState state, const GridSlam* with_map_of);

  CheckpointOptions options_;
  std::map<std::string, std::string> stage_options_;
  StageMonitor& monitor_;
  std::optional<Checkpoint> earlier_;  ///< until the first scan
  std::optional<Stamp> last_map_;      ///< when the map was last started to be written
  int maps_begun_ = 0;                 ///< in it
  std::optional<std::uint32_t> id_;    ///< of the checkpoint with that map, once written
  NewestWorker<Job, Result> worker_;   ///< last: its thread uses the options
};

}  // namespace datmo
