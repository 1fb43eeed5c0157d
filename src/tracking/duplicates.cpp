// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/duplicates.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace datmo {

namespace {

/// m, more than the rounding error of distances: the quick test agrees with the exact one.
constexpr double kSlack = 1e-6;

/// A target and its box, which is too costly to compute for most pairs.
struct BoxedTarget {
  const Target* target;
  Box2 box;
  double reach;  ///< m, from its center; upper bound for reaches()
};

bool hasLowerX(const BoxedTarget& a, const BoxedTarget& b) {
  return a.box.center.x() < b.box.center.x();
}

bool isPartOf(const BoxedTarget& part, const BoxedTarget& whole, const DuplicateOptions& options) {
  const Point2 offset = part.box.center.position() - whole.box.center.position();
  const double reach = std::max(part.reach, whole.reach);
  if (offset.squaredNorm() > reach * reach) {
    return false;
  }
  const bool older =
      whole.target->confirmed() &&
      (!part.target->confirmed() || whole.target->confirmedAs() < part.target->confirmedAs());
  if (!older || !(reaches(whole.box, part.box, options.reach) ||
                  reaches(part.box, whole.box, options.reach))) {
    return false;
  }
  const StateEstimate& a = part.target->filter().estimate();
  const StateEstimate& b = whole.target->filter().estimate();
  const Eigen::Vector2d difference = a.mean.segment<2>(2) - b.mean.segment<2>(2);
  const Eigen::Matrix2d covariance =
      a.covariance.block<2, 2>(2, 2) + b.covariance.block<2, 2>(2, 2);
  return difference.dot(covariance.inverse() * difference) <= options.velocity_gate;
}

}  // namespace

bool reaches(Box2 box, const Box2& other, double scale) {
  box.length *= scale;
  box.width *= scale;
  return box.contains(other.center.position());
}

void DuplicateOptions::visit(OptionVisitor& visitor) {
  visitor.number({"reach", "1",
                  "two targets may be parts of one object if the box of one, enlarged by this "
                  "factor, contains the center of the other, and if their velocities agree"},
                 reach, {0.0, 10.0});
}

std::vector<std::uint64_t> findDuplicates(const std::vector<BestTarget>& targets,
                                          const DuplicateOptions& options) {
  std::vector<BoxedTarget> all;
  std::vector<BoxedTarget> confirmed;
  all.reserve(targets.size());
  confirmed.reserve(targets.size());
  double max_reach = 0.0;
  for (const BestTarget& best : targets) {
    const Target* target = best.target;
    const Box2 box = target->box();
    if (!(std::isfinite(box.center.x()) && std::isfinite(box.center.y()))) {
      continue;  // it is lost, and cannot be sorted
    }
    all.push_back({target, box, kSlack + options.reach * box.halfDiagonal()});
    if (target->confirmed()) {
      confirmed.push_back(all.back());
      max_reach = std::max(max_reach, all.back().reach);
    }
  }
  std::sort(confirmed.begin(), confirmed.end(), hasLowerX);
  std::vector<std::uint64_t> result;
  for (const BoxedTarget& part : all) {
    const double reach = std::max(max_reach, part.reach);
    const double x = part.box.center.x();
    const auto begin = std::lower_bound(
        confirmed.begin(), confirmed.end(), x - reach,
        [](const BoxedTarget& target, double min) { return target.box.center.x() < min; });
    for (auto whole = begin; whole != confirmed.end() && whole->box.center.x() <= x + reach;
         ++whole) {
      if (isPartOf(part, *whole, options)) {
        result.push_back(part.target->number());
        break;
      }
    }
  }
  return result;
}

}  // namespace datmo
