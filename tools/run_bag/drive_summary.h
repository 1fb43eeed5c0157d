// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <optional>
#include <set>
#include <string>

#include "graph_runner.h"
#include "input_refusals.h"

#include <geometry_msgs/PoseWithCovarianceStamped.h>

#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/ros/convert/messages.h"

namespace datmo {

/// Summarizes a drive, scan by scan.
class DriveSummary {
 public:
  /// Adds what a stage has published.
  void add(const Publication& publication);

  std::size_t fusedGrids() const { return fused_grids_; }
  std::size_t fusedLists() const { return fused_lists_; }          ///< of objects
  std::size_t droppedObjects() const { return dropped_objects_; }  ///< at borders of the road
  std::size_t scans() const { return scans_; }
  double distance() const { return distance_; }  ///< m, along the estimated poses
  std::size_t fusedTrackLists() const { return tracks_are_fused_ ? track_lists_ : 0; }
  std::size_t trackLists() const { return track_lists_ + source_track_lists_; }
  std::size_t tracks() const { return track_ids_.size(); }

 private:
  void addPose(const geometry_msgs::PoseWithCovarianceStamped& pose);
  void addTracks(const std::string& topic, const TrackArray& tracks);

  std::size_t fused_grids_ = 0;
  std::size_t fused_lists_ = 0;
  std::size_t dropped_objects_ = 0;
  std::size_t track_lists_ = 0;
  std::size_t source_track_lists_ = 0;  ///< that are fused, or would be
  bool tracks_are_fused_ = false;
  std::size_t scans_ = 0;
  double distance_ = 0.0;
  std::optional<Point2> position_;  ///< m, map frame, after the last scan
  std::set<std::uint32_t> track_ids_;
};

struct RunTime {
  double data = 0.0;  ///< s, length of the bag
  double wall = 0.0;  ///< s, processing
};

/// The table at the end: the drive, the time of each stage, speed, and what was dropped and why.
void printTable(std::ostream& out, const DriveSummary& drive, const GraphRunner& graph,
                const InputRefusals& refusals, const RunTime& time);

}  // namespace datmo
