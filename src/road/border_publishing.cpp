// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/road/border_publishing.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "datmo_fusion/common/log_odds.h"

namespace datmo {

namespace {

/// A point of a border at a station of the vehicle's heading.
struct StationPoint {
  const FollowedBorder* border = nullptr;
  double outward = 0.0;  ///< m, from the vehicle
  double log_odds = 0.0;
  BorderPoint point;
};

using Stations = std::vector<StationPoint>;

/// Enters the sections of one line at the stations where it is innermost.
void enter(const FollowedBorder& border, const Pose2& map_in_vehicle,
           const BorderPublishingOptions& options, Stations& stations) {
  const CurveTable& table = border.table();
  const double arc_length = border.track().arcLength();
  for (const ArcLengthInterval& piece : border.evidence().pieces()) {
    if (piece.last - piece.first < options.min_length) {
      continue;
    }
    for (double at = piece.first; at <= piece.last; at += 0.5 * options.spacing) {
      const double along = at - arc_length;
      if (along < table.first() || along > table.last()) {
        continue;
      }
      const double sigma = border.sigmaAt(along);
      const Point2 position = table.at(along).position();
      const Point2 seen = map_in_vehicle * position;
      const double index = std::floor((seen.x() + options.behind) / options.spacing);
      const double outward = outwardOf(border.side(), seen.y());
      if (sigma > options.max_sigma || index < 0.0 ||
          index >= static_cast<double>(stations.size())) {
        continue;
      }
      StationPoint& station = stations[static_cast<std::size_t>(index)];
      if (station.border == nullptr || outward < station.outward) {
        station = {&border, outward, border.evidence().logOdds(at), {position, sigma}};
      }
    }
  }
}

void finish(std::vector<RoadBorder>& published) {
  if (!published.empty() && published.back().points.size() < 2) {
    published.pop_back();
  }
}

}  // namespace

void BorderPublishingOptions::visit(OptionVisitor& visitor) {
  visitor.number({"ahead", "m", "how far ahead of the vehicle borders are published", Tier::kLive},
                 ahead, {1.0, 200.0});
  visitor.number({"behind", "m", "how far behind the vehicle", Tier::kLive}, behind, {0.0, 200.0});
  visitor.number({"max_sigma", "m",
                  "lateral standard deviation above which a border is not published", Tier::kLive},
                 max_sigma, {0.05, 10.0});
  visitor.number({"min_length", "m",
                  "minimum length of a published piece of border: posts are shorter", Tier::kLive},
                 min_length, {0.0, 50.0});
  visitor.number({"spacing", "m", "spacing of a border's points along the vehicle's heading"},
                 spacing, {0.1, 20.0});
}

std::vector<RoadBorder> publishedBorders(const std::vector<FollowedBorder>& borders,
                                         const Pose2& vehicle,
                                         const BorderPublishingOptions& options) {
  const Pose2 map_in_vehicle = vehicle.inverse();
  const auto count =
      static_cast<std::size_t>(std::ceil((options.ahead + options.behind) / options.spacing));
  std::vector<RoadBorder> published;
  for (const RoadSide side : {RoadSide::kLeft, RoadSide::kRight}) {
    Stations stations(count);
    for (const FollowedBorder& border : borders) {
      if (border.side() == side && border.state() == FollowedBorder::State::kConfirmed) {
        enter(border, map_in_vehicle, options, stations);
      }
    }
    const FollowedBorder* last = nullptr;
    for (const StationPoint& station : stations) {
      if (station.border != last) {
        finish(published);
        last = station.border;
        if (last != nullptr) {
          RoadBorder& border = published.emplace_back();
          border.side = side;
          border.unseen_for = last->unseenFor();
        }
      }
      if (last != nullptr) {
        RoadBorder& border = published.back();
        border.points.push_back(station.point);
        border.probability = std::max(border.probability, probabilityOf(station.log_odds));
      }
    }
    finish(published);
  }
  return published;
}

}  // namespace datmo
