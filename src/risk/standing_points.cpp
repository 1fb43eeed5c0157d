// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/risk/standing_points.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <utility>

namespace datmo {

StandingPoints::StandingPoints(const std::vector<Point2>& points, double spacing) {
  std::set<std::pair<std::int64_t, std::int64_t>> taken;
  for (const Point2& point : points) {
    const Point2 cell = point / spacing;
    if (cell.allFinite() && taken.emplace(std::llround(cell.x()), std::llround(cell.y())).second) {
      points_.push_back(point);
    }
  }
  std::sort(points_.begin(), points_.end(), [](const Point2& a, const Point2& b) {
    return std::make_pair(a.x(), a.y()) < std::make_pair(b.x(), b.y());
  });
}

std::optional<StandingPoints::Contact> StandingPoints::firstContact(const BodyPath& path,
                                                                    const BodySize& size) const {
  for (std::size_t i = 0; i + 1 < path.poses.size(); ++i) {
    std::optional<Contact> first;
    checkMove({path.poses[i], path.poses[i + 1], size}, static_cast<double>(i) * path.step,
              path.step, first);
    if (first) {
      return first;
    }
  }
  return std::nullopt;
}

void StandingPoints::checkMove(const BodyMove& move, double start, double step,
                               std::optional<Contact>& first) const {
  const Point2 middle = 0.5 * (move.from.center + move.to.center);
  const double reach = 0.5 * (move.to.center - move.from.center).norm() + move.size.radius();
  const auto begin = std::lower_bound(points_.begin(), points_.end(), middle.x() - reach,
                                      [](const Point2& point, double x) { return point.x() < x; });
  for (auto point = begin; point != points_.end() && point->x() <= middle.x() + reach; ++point) {
    if ((*point - middle).squaredNorm() > reach * reach) {
      continue;
    }
    const BodyPose still = bodyPose(*point, 0.0);
    if (const auto share = datmo::firstContact(move, {still, still, BodySize()})) {
      const double time = start + *share * step;
      if (!first || time < first->time) {
        first = Contact{time, *point};
      }
    }
  }
}

}  // namespace datmo
