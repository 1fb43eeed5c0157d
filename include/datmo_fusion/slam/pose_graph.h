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
  int max_iterations = 50;

  void visit(OptionVisitor& visitor);
};

/// A measured motion from one pose of a graph to another one.
struct PoseConstraint {
  std::size_t from = 0;
  std::size_t to = 0;
  Pose2 motion;                                          ///< the pose `to` in the frame of `from`
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< x, y, heading in that frame
};

/// Poses of one drive, and what was measured between them: from each one to the next by the live
/// SLAM, and between distant ones by loops (Lu & Milios 1997; Grisetti et al. 2010).
///
/// The optimized poses have the least sum of squared errors, each in standard deviations of its
/// constraint; the first pose stays. A loop that contradicts all others counts less and less
/// (Cauchy's kernel), so that a false one cannot tear the graph apart.
class PoseGraph {
 public:
  /// Throws OptionError.
  explicit PoseGraph(const Checked<PoseGraphOptions>& options);

  /// The first pose.
  void start(const Pose2& pose);

  /// The next pose, by the motion from the last one and its covariance (positive definite).
  void extend(const Pose2& motion, const Eigen::Matrix3d& covariance);

  /// A loop between poses that there are; its covariance positive definite.
  void close(const PoseConstraint& loop) { loops_.push_back(loop); }

  /// Moves the poses to where all constraints are met best, as far as the iterations allow. Returns
  /// whether the solver could do that; if not (a loop that is not finite), the poses stay as they
  /// were, and the loops since the last time are taken out.
  bool optimize();

  const std::vector<Pose2>& poses() const { return poses_; }
  const std::vector<PoseConstraint>& loops() const { return loops_; }

  /// Motions from each pose to the next one.
  const std::vector<PoseConstraint>& motions() const { return motions_; }

  /// Covariance of a pose (x, y, heading in the axes of all poses) with each of the others as the
  /// origin: along the path of motions and loops on which its position has the least variance
  /// (Dijkstra's projection: Bosse et al. 2003). All constraints together say no less.
  std::vector<Eigen::Matrix3d> covariancesOf(std::size_t pose) const;

  /// The same with one other pose as the origin.
  Eigen::Matrix3d covarianceBetween(std::size_t origin, std::size_t pose) const;

  /// Squared error of a constraint, in standard deviations.
  double squaredError(const PoseConstraint& constraint) const;

  /// Takes out the loops whose squared error is larger than this; returns how many.
  std::size_t removeLoops(double above);

  void clear();

 private:
  /// covariancesOf(), until that with this origin is known.
  std::vector<Eigen::Matrix3d> covariancesUntil(std::size_t origin, std::size_t pose) const;

  PoseGraphOptions options_;
  std::vector<Pose2> poses_;
  std::vector<PoseConstraint> motions_;
  std::vector<PoseConstraint> loops_;
  std::size_t optimized_loops_ = 0;  ///< of these
};

}  // namespace datmo
