// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/road/road_opening.h"

#include <cmath>
#include <limits>

#include "datmo_fusion/common/angle.h"

namespace datmo {

namespace {

/// Minimum border probability before an opening.
constexpr double kBorderAbove = 0.6;

/// Maximum border probability of an opening.
constexpr double kOpenBelow = 0.4;

/// Lateral distance of an opening on a side without any known border, m.
constexpr double kUsualDistance = 5.0;

/// Lateral distance, m, from the vehicle's axis to the border of its own road nearest to a station
/// ahead; `otherwise` if there is none.
double distanceTo(const std::vector<RoadBorder>& borders, RoadSide side, const Pose2& map_in_base,
                  double ahead, double otherwise) {
  double nearest = std::numeric_limits<double>::infinity();
  double distance = otherwise;
  for (const RoadBorder& border : borders) {
    if (border.side != side || border.side_street) {
      continue;
    }
    for (const BorderPoint& point : border.points) {
      const Point2 seen = map_in_base * point.position;
      if (std::abs(seen.x() - ahead) < nearest) {
        nearest = std::abs(seen.x() - ahead);
        distance = std::abs(seen.y());
      }
    }
  }
  return distance;
}

}  // namespace

void RoadOpeningOptions::visit(OptionVisitor& visitor) {
  visitor.number(
      {"min_length", "m", "minimum length along the road; streets are wider, curbs are rounded"},
      min_length, {0.5, 100.0});
  visitor.number(
      {"max_length", "m", "greatest length along the road; longer openings are not streets"},
      max_length, {0.5, 1000.0});
}

std::vector<RoadOpening> openingsOf(const BorderPresence& presence,
                                    const std::vector<RoadBorder>& borders,
                                    const Pose2& base_in_map, const RoadOpeningOptions& options) {
  std::vector<RoadOpening> openings;
  const Pose2 map_in_base = base_in_map.inverse();
  for (const RoadSide side : {RoadSide::kLeft, RoadSide::kRight}) {
    const SidePresence& stations = side == RoadSide::kLeft ? presence.left : presence.right;
    const double outward = outwardOf(side, 1.0);
    bool behind_border = false;
    std::size_t begin = 0;
    for (std::size_t i = 0; i <= stations.probability.size(); ++i) {
      const bool end = i == stations.probability.size();
      if (!end && stations.probability[i] < kOpenBelow) {
        continue;
      }
      const double length = static_cast<double>(i - begin) * stations.station_length;
      if (behind_border && length >= options.min_length && length <= options.max_length) {
        const double middle = 0.5 * (static_cast<double>(begin) + static_cast<double>(i) - 1.0);
        const double ahead =
            stations.first_station + middle * stations.station_length - presence.arc_length;
        const double aside = distanceTo(borders, side, map_in_base, ahead, kUsualDistance);
        openings.push_back(
            {side, base_in_map * Pose2(ahead, outward * aside, outward * 0.5 * kPi), length});
      }
      behind_border = behind_border || (!end && stations.probability[i] > kBorderAbove);
      begin = i + 1;
    }
  }
  return openings;
}

}  // namespace datmo
