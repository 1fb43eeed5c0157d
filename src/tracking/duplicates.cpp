#include "datmo_fusion/tracking/duplicates.h"

#include <algorithm>
#include <iterator>

#include <Eigen/LU>

namespace datmo {

namespace {

/// Whether a box of `scale` times its size holds the other's centre.
bool reaches(Box2 box, const Box2& other, double scale) {
  box.length *= scale;
  box.width *= scale;
  return box.contains(other.centre.position());
}

bool isPartOf(const Target& part, const Target& whole, const DuplicateOptions& options) {
  const bool older = whole.confirmed() && (!part.confirmed() || whole.id() < part.id());
  if (!older || !(reaches(whole.box(), part.box(), options.reach) ||
                  reaches(part.box(), whole.box(), options.reach))) {
    return false;
  }
  const StateEstimate& a = part.filter().estimate();
  const StateEstimate& b = whole.filter().estimate();
  const Eigen::Vector2d difference = a.mean.segment<2>(2) - b.mean.segment<2>(2);
  const Eigen::Matrix2d covariance =
      a.covariance.block<2, 2>(2, 2) + b.covariance.block<2, 2>(2, 2);
  return difference.dot(covariance.inverse() * difference) <= options.velocity_gate;
}

}  // namespace

void DuplicateOptions::visit(OptionVisitor& visitor) {
  visitor.number({"reach", "1",
                  "two targets may be parts of one object where the box of one, this many times as "
                  "large, holds the centre of the other"},
                 reach, {0.0, 10.0});
  visitor.number({"velocity_gate", "1",
                  "they are if their velocities are within this Mahalanobis distance squared: 13.8 "
                  "is the 99.9 % quantile of chi-square with two degrees of freedom"},
                 velocity_gate, {0.0, 1000.0});
}

std::size_t removeDuplicates(std::vector<Target>& targets, const DuplicateOptions& options) {
  std::vector<Target> kept;
  kept.reserve(targets.size());
  std::copy_if(targets.begin(), targets.end(), std::back_inserter(kept), [&](const Target& part) {
    return std::none_of(targets.begin(), targets.end(),
                        [&](const Target& whole) { return isPartOf(part, whole, options); });
  });
  const std::size_t removed = targets.size() - kept.size();
  targets.swap(kept);
  return removed;
}

}  // namespace datmo
