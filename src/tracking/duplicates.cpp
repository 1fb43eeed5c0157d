#include "datmo_fusion/tracking/duplicates.h"

#include <algorithm>

#include <Eigen/LU>

namespace datmo_fusion {

namespace {

bool isPartOf(const Target& part, const Target& whole, double velocity_gate) {
  const bool older = whole.confirmed() && (!part.confirmed() || whole.id() < part.id());
  if (!older || !whole.box().contains(part.box().centre.position())) {
    return false;
  }
  const StateEstimate& a = part.filter().estimate();
  const StateEstimate& b = whole.filter().estimate();
  const Eigen::Vector2d difference = a.mean.segment<2>(2) - b.mean.segment<2>(2);
  const Eigen::Matrix2d covariance =
      a.covariance.block<2, 2>(2, 2) + b.covariance.block<2, 2>(2, 2);
  return difference.dot(covariance.inverse() * difference) <= velocity_gate;
}

}  // namespace

std::size_t removeDuplicates(std::vector<Target>& targets, double velocity_gate) {
  std::vector<Target> kept;
  kept.reserve(targets.size());
  std::copy_if(targets.begin(), targets.end(), std::back_inserter(kept), [&](const Target& part) {
    return std::none_of(targets.begin(), targets.end(),
                        [&](const Target& whole) { return isPartOf(part, whole, velocity_gate); });
  });
  const std::size_t removed = targets.size() - kept.size();
  targets.swap(kept);
  return removed;
}

}  // namespace datmo_fusion
