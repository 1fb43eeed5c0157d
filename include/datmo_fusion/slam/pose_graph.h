// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/pose2.h"

namespace datmo {

struct PoseGraphOptions {
  double loss_scale = 2.0;  ///< standard deviations
  int max_iterations = 50;  ///< 1 to 1000: maximum number of iterations of one optimization

  void visit(OptionVisitor& visitor);
};

/// A measured motion between two poses of a graph.
struct PoseConstraint {
  std::size_t from = 0;
  std::size_t to = 0;
  Pose2 motion;                                          ///< the pose `to` in the frame of `from`
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< x, y, heading in that frame
};

/// Poses of one drive, and the measurements between them: from each one to the next by the live
/// SLAM, and between distant ones by loops (Lu & Milios 1997; Grisetti et al. 2010).
///
/// The optimized poses minimize the sum of squared errors, each in standard deviations of its
/// constraint; the first pose is fixed. A loop that contradicts all others is downweighted (Cauchy
/// kernel), so that a false one cannot distort the graph.
class PoseGraph {
 public:
  /// Throws OptionError.
  explicit PoseGraph(const Checked<PoseGraphOptions>& options);

  /// Sets the first pose.
  void start(const Pose2& pose);

  /// Adds the next pose, by its motion from the last one and the covariance (positive definite).
  void extend(const Pose2& motion, const Eigen::Matrix3d& covariance);

  /// Adds a loop between existing poses; its covariance must be positive definite.
  void close(const PoseConstraint& loop) { loops_.push_back(loop); }

  /// Optimizes the poses, as far as the iterations allow. Returns whether the solver succeeded; if
  /// not (a loop that is not finite), the poses are unchanged, and the loops added since the last
  /// optimization are removed.
  bool optimize();

  const std::vector<Pose2>& poses() const { return poses_; }
  const std::vector<PoseConstraint>& loops() const { return loops_; }

  /// Returns the motions from each pose to the next.
  const std::vector<PoseConstraint>& motions() const { return motions_; }

  /// Returns the covariance of a pose (x, y, heading along the axes of all poses) relative to each
  /// of the others: along the path of motions and loops on which its position has the smallest
  /// variance (Dijkstra projection: Bosse et al. 2003). It is an upper bound for all constraints
  /// together.
  std::vector<Eigen::Matrix3d> covariancesOf(std::size_t pose) const;

  /// The same relative to one other pose.
  Eigen::Matrix3d covarianceBetween(std::size_t origin, std::size_t pose) const;

  /// Returns the squared error of a constraint, in standard deviations.
  double squaredError(const PoseConstraint& constraint) const;

  /// Removes the loops whose squared error is larger than this; returns how many.
  std::size_t removeLoops(double above);

  void clear();

 private:
  /// covariancesOf(), stopped as soon as that relative to `origin` is known.
  std::vector<Eigen::Matrix3d> covariancesUntil(std::size_t origin, std::size_t pose) const;

  PoseGraphOptions options_;
  std::vector<Pose2> poses_;
  std::vector<PoseConstraint> motions_;
  std::vector<PoseConstraint> loops_;
  std::size_t optimized_loops_ = 0;  ///< of these
};

}  // namespace datmo
