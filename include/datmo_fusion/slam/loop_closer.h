// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/slam/keyframe.h"
#include "datmo_fusion/slam/pose_graph.h"
#include "datmo_fusion/slam/submap_matcher.h"

namespace datmo {

struct LoopCloserOptions {
  double submap_length = 20.0;   ///< m
  double search_distance = 5.0;  ///< m
  double min_loop = 60.0;        ///< m
  double max_distance = 8.0;     ///< m
  /// m, 0 to 1000: where the drift may be larger (standard deviation), a loop needs a second one
  /// that confirms it
  double trusted_sigma = 1.0;
  double max_sigma = 20.0;              ///< m
  double position_drift = 0.05;         ///< m per square root of m
  double heading_drift = degrees(0.2);  ///< rad per square root of m
  int max_scans = 20000;
  PoseGraphOptions graph;
  SubmapMatcherOptions submaps;

  void visit(OptionVisitor& visitor);
};

/// A closed loop between two times of the drive.
struct ClosedLoop {
  Stamp from;
  Stamp to;
  Pose2 motion;  ///< the vehicle's pose at `to` in its frame at `from`
};

/// Results of the searches so far.
struct LoopCounts {
  std::size_t closed = 0;
  std::size_t unconfirmed = 0;  ///< found, but not confirmed by another
  std::size_t ambiguous = 0;
  std::size_t unlike = 0;   ///< the submaps do not match
  std::size_t refuted = 0;  ///< removed later, because the other loops contradict them
};

/// Loop closure behind the live SLAM (Hess et al. 2016): keeps scans of the drive, searches earlier
/// ones for what the vehicle has just seen, and optimizes the whole trajectory.
///
/// Frames: `map` is that of the live SLAM, which drifts; `global` is that of the optimized poses.
/// Both coincide at the first keyframe.
///
/// Every `search_distance`, the last `submap_length` of the drive is matched (SubmapMatcher) with
/// the part of the drive that is nearest by the optimized poses, at least `min_loop` earlier,
/// within the drift between the two that all loops so far allow. If that is large, a loop only
/// counts if a second one, found from other scans, agrees with it: a wrong loop is worse than none.
/// Not thread-safe.
class LoopCloser {
 public:
  /// Throws OptionError, also for a `min_loop` shorter than `submap_length`: a submap would be
  /// compared with itself.
  explicit LoopCloser(const Checked<LoopCloserOptions>& options);

  /// Adds the next keyframe of the drive, or the first one. Returns whether a loop was closed,
  /// which changes all poses.
  bool add(Keyframe keyframe);

  /// Adds a pose of the live SLAM since the last keyframe, for trajectory(), in ascending stamp
  /// order. At rest, two per second are kept.
  void addPose(const StampedPose& base_in_map);

  /// Returns the optimized poses of all keyframes and of those added in between, in `global`.
  std::vector<StampedPose> trajectory() const;

  /// Returns the pose of the frame `map` in `global`, as of the last keyframe.
  Pose2 mapInGlobal() const;

  /// Returns the map of all kept scans, in `global`. Its cells have the size given in the options,
  /// doubled as often as needed to keep it within four million cells. Throws OptionError if that
  /// exceeds the largest cell size.
  OccupancyMap map() const;

  const LoopCounts& counts() const { return counts_; }

  /// Returns all loops in the graph.
  std::vector<ClosedLoop> loops() const;

  const PoseGraph& graph() const { return graph_; }

  /// Returns the RMS of the loops' errors, in standard deviations; 0 without loops.
  double residual() const;

  /// Returns the memory used by kept scans and poses.
  std::size_t bytes() const;
  std::size_t scans() const { return scans_; }
  double length() const { return nodes_.empty() ? 0.0 : nodes_.back().distance; }

  void clear();

 private:
  struct Node {
    Keyframe keyframe;
    double distance = 0.0;               ///< m, driven so far
    std::vector<StampedPose> followers;  ///< relative to the keyframe
  };

  /// The result of a search, not confirmed by another one yet.
  using Candidate = PoseConstraint;

  void append(Keyframe keyframe);
  Eigen::Matrix3d driftOf(const Keyframe& from, const Keyframe& to, double distance) const;
  void thinOut();
  bool search();
  bool judge(const Candidate& candidate, double prior_sigma);
  bool agree(const Candidate& a, const Candidate& b) const;
  bool optimize();

  /// Index of the keyframe in the middle of the last submap_length; none if the drive is shorter.
  std::optional<std::size_t> middleOfLast() const;
  /// The earlier keyframe to be compared with this one; `drift` is the latter's covariance relative
  /// to each of the others.
  std::optional<std::size_t> oldNear(std::size_t node,
                                     const std::vector<Eigen::Matrix3d>& drift) const;
  /// Keyframes from `from` to `to` (m of the drive) that have scans, in the frame of one of them.
  Submap submap(double from, double to, std::size_t frame) const;

  LoopCloserOptions options_;
  SubmapMatcher matcher_;
  PoseGraph graph_;
  std::vector<Node> nodes_;
  std::vector<Candidate> candidates_;
  LoopCounts counts_;
  double searched_ = 0.0;  ///< m of the drive
  std::size_t scans_ = 0;
  std::size_t stride_ = 1;  ///< one in this many keyframes keeps its scan
};

}  // namespace datmo
