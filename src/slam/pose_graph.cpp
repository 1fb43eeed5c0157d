// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/pose_graph.h"

#include <algorithm>
#include <array>

#include <Eigen/Cholesky>
#include <ceres/ceres.h>

namespace datmo {

namespace {

using Parameters = std::array<double, 3>;  // x, y (m), heading (rad)

/// Matrix that scales an error of this covariance to standard deviations.
Eigen::Matrix3d whitening(const Eigen::Matrix3d& covariance) {
  return covariance.llt().matrixL().solve(Eigen::Matrix3d::Identity());
}

/// Error of a constraint, for automatic differentiation.
class ConstraintError {
 public:
  explicit ConstraintError(const PoseConstraint& constraint)
      : motion_(constraint.motion), whitening_(whitening(constraint.covariance)) {}

  template <typename T>
  bool operator()(const T* from, const T* to, T* residual) const {
    const T c = cos(from[2]);
    const T s = sin(from[2]);
    const T x = to[0] - from[0];
    const T y = to[1] - from[1];
    const T turn = to[2] - from[2] - motion_.heading();
    const Eigen::Matrix<T, 3, 1> error(c * x + s * y - motion_.x(), c * y - s * x - motion_.y(),
                                       atan2(sin(turn), cos(turn)));
    Eigen::Map<Eigen::Matrix<T, 3, 1>>{residual} = whitening_.cast<T>() * error;
    return true;
  }

 private:
  Pose2 motion_;
  Eigen::Matrix3d whitening_;
};

Parameters toParameters(const Pose2& pose) { return {pose.x(), pose.y(), pose.heading()}; }

Pose2 toPose(const Parameters& parameters) { return {parameters[0], parameters[1], parameters[2]}; }

}  // namespace

void PoseGraphOptions::visit(OptionVisitor& visitor) {
  visitor.number(
      {"loss_scale", "1",
       "a loop with an error of this many standard deviations has half the weight (Cauchy)"},
      loss_scale, {0.1, 100.0});
}

PoseGraph::PoseGraph(const Checked<PoseGraphOptions>& options) : options_(*options) {}

void PoseGraph::clear() {
  poses_.clear();
  motions_.clear();
  loops_.clear();
  optimized_loops_ = 0;
}

void PoseGraph::start(const Pose2& pose) {
  clear();
  poses_.push_back(pose);
}

void PoseGraph::extend(const Pose2& motion, const Eigen::Matrix3d& covariance) {
  motions_.push_back({poses_.size() - 1, poses_.size(), motion, covariance});
  poses_.push_back(poses_.back() * motion);
}

double PoseGraph::squaredError(const PoseConstraint& constraint) const {
  const Parameters from = toParameters(poses_[constraint.from]);
  const Parameters to = toParameters(poses_[constraint.to]);
  Eigen::Vector3d error;
  ConstraintError{constraint}(from.data(), to.data(), error.data());
  return error.squaredNorm();
}

std::size_t PoseGraph::removeLoops(double above) {
  const auto kept = std::remove_if(loops_.begin(), loops_.end(), [&](const PoseConstraint& loop) {
    return squaredError(loop) > above;
  });
  const auto removed = static_cast<std::size_t>(loops_.end() - kept);
  loops_.erase(kept, loops_.end());
  optimized_loops_ = std::min(optimized_loops_, loops_.size());
  return removed;
}

bool PoseGraph::optimize() {
  std::vector<Parameters> parameters;
  parameters.reserve(poses_.size());
  std::transform(poses_.begin(), poses_.end(), std::back_inserter(parameters), toParameters);
  ceres::Problem problem;
  const auto add = [&](const PoseConstraint& constraint, ceres::LossFunction* loss) {
    auto* cost =
        new ceres::AutoDiffCostFunction<ConstraintError, 3, 3, 3>(new ConstraintError(constraint));
    problem.AddResidualBlock(cost, loss, parameters[constraint.from].data(),
                             parameters[constraint.to].data());
  };
  for (const PoseConstraint& motion : motions_) {
    add(motion, nullptr);
  }
  for (const PoseConstraint& loop : loops_) {
    add(loop, new ceres::CauchyLoss(options_.loss_scale));
  }
  if (!motions_.empty()) {
    problem.SetParameterBlockConstant(parameters.front().data());
  }
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  solver.max_num_iterations = options_.max_iterations;
  solver.num_threads = 1;  // summation in a fixed order gives identical poses
  solver.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &problem, &summary);
  if (!summary.IsSolutionUsable()) {
    loops_.resize(optimized_loops_);
    return false;
  }
  optimized_loops_ = loops_.size();
  std::transform(parameters.begin(), parameters.end(), poses_.begin(), toPose);
  return true;
}

}  // namespace datmo
