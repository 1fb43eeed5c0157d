// SPDX-License-Identifier: BSD-3-Clause
// The options and the outputs of LoopCloser.
#include <cmath>

#include <Eigen/Geometry>

#include "datmo_fusion/common/square.h"
#include "datmo_fusion/slam/loop_closer.h"

namespace datmo {

namespace {

/// Maximum number of cells of the optimized map: 220 MB while it is built.
constexpr double kMaxCells = 4e6;

/// m; of the window before its actual size is set.
constexpr double kAnyLength = 1.0;

GridWindow windowOf(const Eigen::AlignedBox2d& extent, double cell_size) {
  GridWindow window{cell_size, 1, 1, {}};
  window.corner = window.cellAt(extent.min());
  const CellIndex last = window.cellAt(extent.max());
  window.columns = last.column - window.corner.column + 1;
  window.rows = last.row - window.corner.row + 1;
  return window;
}

}  // namespace

void LoopCloserOptions::visit(OptionVisitor& visitor) {
  visitor.number({"submap_length", "m", "length of the drive that a submap covers"}, submap_length,
                 {1.0, 1000.0});
  visitor.number({"search_distance", "m", "distance between two searches for a loop"},
                 search_distance, {0.1, 1000.0});
  visitor.number({"min_loop", "m", "a loop is no shorter than this distance driven"}, min_loop,
                 {1.0, 100000.0});
  visitor.number({"max_distance", "m",
                  "distance between the poses of a loop, in addition to the possible drift since "
                  "the last loop"},
                 max_distance, {0.1, 1000.0});
  visitor.number(
      {"max_sigma", "m",
       "where the drift may be larger (standard deviation), no loop is searched for: in so "
       "wide an area some place looks similar"},
      max_sigma, {0.1, 1000.0});
  visitor.number({"position_drift", "m/m^0.5",
                  "drift of the live SLAM along the drive, in addition to its own covariance "
                  "(standard deviation)"},
                 position_drift, {0.0001, 10.0});
  visitor.number({"heading_drift", "rad/m^0.5", "the same for the heading"}, heading_drift,
                 {0.00001, 1.0});
  visitor.integer({"max_scans", "1",
                   "maximum number of scans that are kept; beyond it, every second one is dropped, "
                   "and from then on half as many are kept"},
                  max_scans, {10, 10000000});
  visitor.group("graph", [&] { graph.visit(visitor); });
  submaps.visit(visitor);
}

Pose2 LoopCloser::mapInGlobal() const {
  return nodes_.empty() ? Pose2()
                        : graph_.poses().back() * nodes_.back().keyframe.base_in_map.pose.inverse();
}

std::vector<StampedPose> LoopCloser::trajectory() const {
  std::vector<StampedPose> trajectory;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Pose2& pose = graph_.poses()[i];
    trajectory.push_back({nodes_[i].keyframe.stamp, pose});
    for (const StampedPose& follower : nodes_[i].followers) {
      trajectory.push_back({follower.stamp, pose * follower.pose});
    }
  }
  return trajectory;
}

OccupancyMap LoopCloser::map() const {
  const double reach = options_.submaps.search.reach;
  Eigen::AlignedBox2d extent;
  for (const Pose2& pose : graph_.poses()) {
    extent.extend(pose.position());
  }
  if (extent.isEmpty()) {
    extent.extend(Point2(Point2::Zero()));
  }
  extent.extend(extent.min() - Point2::Constant(reach));
  extent.extend(extent.max() + Point2::Constant(reach));
  OccupancyMapOptions options = options_.submaps.map;
  while (extent.volume() > kMaxCells * square(options.window.cell_size)) {
    options.window.cell_size *= 2.0;
  }
  options.window.length = options.window.width = kAnyLength;
  OccupancyMap map(options);
  map.setWindow(windowOf(extent, options.window.cell_size));
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Keyframe& keyframe = nodes_[i].keyframe;
    if (!keyframe.scan.empty()) {
      addStatic(map, keyframe.scan.scan(keyframe.stamp), graph_.poses()[i]);
    }
  }
  return map;
}

std::vector<ClosedLoop> LoopCloser::loops() const {
  std::vector<ClosedLoop> loops;
  for (const PoseConstraint& loop : graph_.loops()) {
    loops.push_back(
        {nodes_[loop.from].keyframe.stamp, nodes_[loop.to].keyframe.stamp, loop.motion});
  }
  return loops;
}

double LoopCloser::residual() const {
  double sum = 0.0;
  for (const PoseConstraint& loop : graph_.loops()) {
    sum += graph_.squaredError(loop);
  }
  return graph_.loops().empty() ? 0.0 : std::sqrt(sum / static_cast<double>(graph_.loops().size()));
}

std::size_t LoopCloser::bytes() const {
  std::size_t bytes = 0;
  for (const Node& node : nodes_) {
    bytes += sizeof(Node) + sizeof(Pose2) + sizeof(PoseConstraint) + node.keyframe.scan.bytes() +
             node.followers.size() * sizeof(StampedPose);
  }
  return bytes;
}

}  // namespace datmo
