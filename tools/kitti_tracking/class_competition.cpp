// SPDX-License-Identifier: BSD-3-Clause
#include "kitti_tracking/class_competition.h"

#include <cmath>
#include <cstddef>

namespace datmo::kitti {

namespace {

bool isSamePosition(const Box2& a, const Box2& b) {
  const double distance = (a.center.position() - b.center.position()).norm();
  const bool near = distance <= a.length + a.width + b.length + b.width;
  return near && (a.contains(b.center.position()) || b.contains(a.center.position()));
}

/// Logarithm of one plus the odds.
double softPlus(double log_odds) {
  return log_odds > 0.0 ? log_odds + std::log1p(std::exp(-log_odds))
                        : std::log1p(std::exp(log_odds));
}

/// The amount by which the objects of the other lists reduce the log odds of this one.
double taken(const Object& object, std::size_t own, const std::vector<ObjectList>& lists) {
  double sum = 0.0;
  for (std::size_t i = 0; i < lists.size(); ++i) {
    if (i == own) {
      continue;
    }
    for (const Object& other : lists[i].objects) {
      if (isSamePosition(object.box, other.box)) {
        sum += softPlus(other.log_odds);
      }
    }
  }
  return sum;
}

}  // namespace

void compete(std::vector<ObjectList>& lists) {
  const std::vector<ObjectList> before = lists;
  for (std::size_t i = 0; i < lists.size(); ++i) {
    for (Object& object : lists[i].objects) {
      object.log_odds -= taken(object, i, before);
    }
  }
}

}  // namespace datmo::kitti
