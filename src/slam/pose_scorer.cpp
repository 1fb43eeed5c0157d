// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/pose_scorer.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "datmo_fusion/common/wide.h"

namespace datmo {

namespace {

/// Every kSpread-th point comes first, then those next to them, and so on.
constexpr std::size_t kSpread = 8;

/// m; bound on the rounding error of the sum of a position and a rotated point.
constexpr double kRounding = 1e-6;

/// The most occupied cell is searched for if that costs at most this share of the lookups of all
/// poses.
constexpr double kSearchShare = 0.1;

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

/// Same as in GridWindow::cellAt, in a vectorizable loop.
template <std::size_t kCount>
inline std::array<int, kCount> floorOf(const std::array<double, kCount>& numbers) {
  std::array<int, kCount> result;
  for (std::size_t i = 0; i < kCount; ++i) {
    const int whole = static_cast<int>(numbers[i]);
    result[i] = whole - (numbers[i] < static_cast<double>(whole) ? 1 : 0);
  }
  return result;
}

}  // namespace

PoseScorer::PoseScorer(const OccupancyMap& map, const std::vector<EndPoint>& points)
    : map_(map),
      count_(points.size()),
      max_distance_(0.5 * GridWindow::kMaxCell * map.window().cell_size) {
  const std::size_t blocks = (count_ + kBlock - 1) / kBlock;
  x_.reserve(blocks * kBlock);
  y_.reserve(blocks * kBlock);
  for (std::size_t first = 0; first < kSpread; ++first) {
    for (std::size_t i = first; i < count_; i += kSpread) {
      x_.push_back(points[i].position.x() / map.window().cell_size);
      y_.push_back(points[i].position.y() / map.window().cell_size);
    }
  }
  for (const EndPoint& point : points) {
    const double range = point.position.norm();
    max_range_ = std::isfinite(range) ? std::max(max_range_, range) : kUnbounded;
  }
  x_.resize(blocks * kBlock, 0.0);
  y_.resize(blocks * kBlock, 0.0);
}

Point2 PoseScorer::pointAt(std::size_t index) const {
  return map_.window().cell_size * Point2(x_[index], y_[index]);
}

DATMO_FUSION_WIDE
double PoseScorer::sumOfBlock(std::size_t begin, const Pose2& pose,
                              const Eigen::Matrix2d& rotation) const {
  const std::size_t count = std::min(kBlock, count_ - begin);
  // With the comparison in this order NaN counts as far away.
  if (std::abs(pose.x()) + std::abs(pose.y()) + max_range_ < max_distance_ &&
      std::isfinite(pose.heading())) {
    const Point2 from = pose.position() / map_.window().cell_size;
    const double c = rotation(0, 0);
    const double s = rotation(1, 0);
    const double* x = &x_[begin];
    const double* y = &y_[begin];
    Block across;
    Block along;
    for (std::size_t i = 0; i < kBlock; ++i) {
      across[i] = from.x() + (c * x[i] - s * y[i]);
    }
    for (std::size_t i = 0; i < kBlock; ++i) {
      along[i] = from.y() + (s * x[i] + c * y[i]);
    }
    return map_.occupancySum(floorOf(across), floorOf(along), count);
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const Point2 end = pose.position() + rotation * pointAt(begin + i);
    sum += map_.occupancy(map_.window().cellAt(end));
  }
  return sum;
}

double PoseScorer::score(const Pose2& pose) const {
  const Eigen::Matrix2d rotation = pose.rotation();
  double sum = 0.0;
  for (std::size_t begin = 0; begin < count_; begin += kBlock) {
    sum += sumOfBlock(begin, pose, rotation);
  }
  return count_ == 0 ? 0.0 : sum / static_cast<double>(count_);
}

PoseScorer::Reach PoseScorer::reachOf(const std::vector<Pose2>& poses) {
  Reach reach;
  for (const Pose2& pose : poses) {
    reach.x = std::max(reach.x, std::abs(pose.x() - poses.front().x()));
    reach.y = std::max(reach.y, std::abs(pose.y() - poses.front().y()));
    reach.turn =
        std::max(reach.turn, std::abs(angleBetween(poses.front().heading(), pose.heading())));
  }
  return reach;
}

double PoseScorer::maxAround(const Point2& end, double x_reach, double y_reach) const {
  const CellIndex first = map_.window().cellAt({end.x() - x_reach, end.y() - y_reach});
  const CellIndex last = map_.window().cellAt({end.x() + x_reach, end.y() + y_reach});
  double max = 0.0;
  for (int row = first.row; row <= last.row; ++row) {
    for (int column = first.column; column <= last.column; ++column) {
      max = std::max(max, map_.occupancy({column, row}));
    }
  }
  return max;
}

std::vector<double> PoseScorer::boundsFrom(const Pose2& first, const Reach& reach,
                                           std::size_t poses) const {
  const double cell_size = map_.window().cell_size;
  const double max_cells = kSearchShare * static_cast<double>(poses);
  std::vector<double> bounds(x_.size() / kBlock + 1, 0.0);
  for (std::size_t i = count_; i-- > 0;) {
    const Point2 point = pointAt(i);
    const double aside = point.norm() * reach.turn + kRounding;
    const double x_reach = reach.x + aside;
    const double y_reach = reach.y + aside;
    const bool is_small =
        (2.0 * x_reach / cell_size + 1.0) * (2.0 * y_reach / cell_size + 1.0) <= max_cells;
    const double max = is_small ? maxAround(first * point, x_reach, y_reach) : 1.0;
    const std::size_t block = i / kBlock;
    bounds[block] =
        (i % kBlock == kBlock - 1 || i == count_ - 1 ? bounds[block + 1] : bounds[block]) + max;
  }
  return bounds;
}

Pose2 PoseScorer::bestOf(const std::vector<Pose2>& poses) const {
  const std::vector<double> bounds = boundsFrom(poses.front(), reachOf(poses), poses.size());
  std::size_t best = 0;
  double best_sum = -1.0;
  double best_score = -1.0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Eigen::Matrix2d rotation = poses[i].rotation();
    double sum = 0.0;
    std::size_t begin = 0;
    while (begin < count_ && sum + bounds[begin / kBlock] > best_sum) {
      sum += sumOfBlock(begin, poses[i], rotation);
      begin += kBlock;
    }
    const double score = count_ == 0 ? 0.0 : sum / static_cast<double>(count_);
    // Quotients of unequal sums may still be equal.
    if (begin >= count_ && score > best_score) {
      best = i;
      best_sum = sum;
      best_score = score;
    }
  }
  return poses[best];
}

}  // namespace datmo
