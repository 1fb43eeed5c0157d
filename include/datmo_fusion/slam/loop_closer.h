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
  double submap_length = 20.0;          ///< m
  double search_distance = 5.0;         ///< m
  double min_loop = 60.0;               ///< m
  double max_distance = 8.0;            ///< m
  double trusted_sigma = 1.0;           ///< m
  double max_sigma = 20.0;              ///< m
  double position_drift = 0.05;         ///< m per square root of m
  double heading_drift = degrees(0.2);  ///< rad per square root of m
  int max_scans = 20000;
  PoseGraphOptions graph;
  SubmapMatcherOptions submaps;

  void visit(OptionVisitor& visitor);
};

/// A loop in terms of the drive.
struct ClosedLoop {
  Stamp from;
  Stamp to;
  Pose2 motion;  ///< the vehicle's pose at `to` in its frame at `from`
};

/// What became of the searches so far.
struct LoopCounts {
  std::size_t closed = 0;
  std::size_t unconfirmed = 0;  ///< of what was found and refused
  std::size_t ambiguous = 0;
  std::size_t unlike = 0;   ///< the submaps do not show the same
  std::size_t refuted = 0;  ///< taken out later, since the others contradict them
};

/// Loop closure behind the live SLAM (Hess et al. 2016): keeps scans of the drive, looks in those
/// of long ago for what the vehicle has just seen, and optimizes the whole drive.
///
/// Frames: `map` is that of the live SLAM, which drifts; `global` is where the optimized poses are.
/// Both are the same at the first keyframe.
///
/// Every `search_distance` the last `submap_length` of the drive is looked for in the part of it,
/// driven `min_loop` before, that is nearest by the optimized poses: SubmapMatcher, within what may
/// have drifted between the two by all loops so far. Where that is much, a loop counts only when a
/// second one, found from other scans, agrees with it: a wrong loop is worse than none. Not thread
/// safe.
class LoopCloser {
 public:
  /// Throws OptionError, also for a `min_loop` shorter than `submap_length`: a submap would be
  /// compared with itself.
  explicit LoopCloser(const Checked<LoopCloserOptions>& options);

  /// The next keyframe of the drive; the first one if there is none yet. Returns whether a loop was
  /// closed, so that all poses have changed.
  bool add(Keyframe keyframe);

  /// A pose of the live SLAM since the last keyframe, for trajectory(), by rising stamps. Where the
  /// vehicle stands, two a second are kept.
  void addPose(const StampedPose& base_in_map);

  /// The optimized poses of all keyframes and those added in between, in `global`.
  std::vector<StampedPose> trajectory() const;

  /// The frame `map` in `global` as it is at the last keyframe.
  Pose2 mapInGlobal() const;

  /// The map of all kept scans, in `global`. Its cells have the size that the options say, or that
  /// doubled as often as it takes to hold all in four million of them. Throws OptionError where
  /// that makes cells larger than there are.
  OccupancyMap map() const;

  const LoopCounts& counts() const { return counts_; }

  /// All that are in the graph.
  std::vector<ClosedLoop> loops() const;

  const PoseGraph& graph() const { return graph_; }

  /// Root mean square of the loops' errors, in their standard deviations; 0 without any.
  double residual() const;

  /// Kept scans and poses take so much memory.
  std::size_t bytes() const;
  std::size_t scans() const { return scans_; }
  double length() const { return nodes_.empty() ? 0.0 : nodes_.back().distance; }

  void clear();

 private:
  struct Node {
    Keyframe keyframe;
    double distance = 0.0;               ///< m, driven up to here
    std::vector<StampedPose> followers;  ///< relative to it
  };

  /// What a search has found, and no other one has confirmed yet.
  using Candidate = PoseConstraint;

  void append(Keyframe keyframe);
  Eigen::Matrix3d driftOf(const Keyframe& from, const Keyframe& to, double distance) const;
  void thinOut();
  bool search();
  bool judge(const Candidate& candidate, double prior_sigma);
  bool agree(const Candidate& a, const Candidate& b) const;
  bool optimize();

  /// Index of the keyframe in the middle of the last submap_length; none if that is not driven yet.
  std::optional<std::size_t> middleOfLast() const;
  /// The keyframe of long ago to be compared with this one, whose covariance with each of the
  /// others as the origin this is.
  std::optional<std::size_t> oldNear(std::size_t node,
                                     const std::vector<Eigen::Matrix3d>& drift) const;
  /// Those from `from` to `to` (m of the drive) that have scans, in the frame of one of them.
  Submap submap(double from, double to, std::size_t frame) const;

  LoopCloserOptions options_;
  SubmapMatcher matcher_;
  PoseGraph graph_;
  std::vector<Node> nodes_;
  std::vector<Candidate> candidates_;
  LoopCounts counts_;
  double searched_ = 0.0;  ///< m of the drive
  std::size_t scans_ = 0;
  std::size_t stride_ = 1;  ///< one keyframe of so many keeps its scan
};

}  // namespace datmo
