// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/road/side_streets.h"

#include <algorithm>

namespace datmo {

namespace {

/// m, of two lanes: left borders whose starts are closer belong to the same street, and so do right
/// ones.
constexpr double kStreetWidth = 5.5;

/// m, spacing of the points of a published border.
constexpr double kPointStep = 1.0;

/// Maximum number of borders: two for each of eight streets.
constexpr std::size_t kMaxKnown = 16;

bool cross(const FoundBorder& one, const FoundBorder& other) {
  const Pose2 map_in_one = one.line.inverse();
  const Point2 begin = map_in_one * other.line.position();
  const Point2 end = map_in_one * (other.line * Point2(other.length, 0.0));
  if (begin.y() * end.y() >= 0.0) {
    return false;
  }
  const double x = begin.x() + begin.y() / (begin.y() - end.y()) * (end.x() - begin.x());
  return x >= 0.0 && x <= one.length;
}

/// Whether at most one of two borders can be right: each street has one on either side, and they do
/// not cross.
bool exclude(const FoundBorder& one, const FoundBorder& other) {
  const double apart = (one.line.position() - other.line.position()).norm();
  return (one.side == other.side && apart < kStreetWidth) || cross(one, other);
}

}  // namespace

SideStreetOptions::SideStreetOptions() {
  search.length = 12.0;
  search.left_windows = 15;
  search.heading_range = 0.3;
  search.heading_step = 0.1;
  search.sections = 12;
}

void SideStreetOptions::visit(OptionVisitor& visitor) {
  visitor.number({"period", "s", "time between two searches of the openings"}, period, {0.0, 10.0});
  visitor.number({"memory", "s", "how long a border that was not found again is kept"}, memory,
                 {0.0, 60.0});
  visitor.number({"start", "m",
                  "distance outward from the border of the vehicle's road where searches start: "
                  "curbs are rounded at corners"},
                 start, {0.0, 20.0});
  visitor.group("search", [&] { search.visit(visitor); });
}

SideStreets::SideStreets(const Checked<SideStreetOptions>& options)
    : options_(*options), search_(options->search) {}

void SideStreets::update(const HitGrid& hits, const std::vector<RoadOpening>& openings,
                         Stamp stamp) {
  if (last_look_ && secondsBetween(*last_look_, stamp) < options_.period) {
    return;
  }
  last_look_ = stamp;
  known_.erase(std::remove_if(known_.begin(), known_.end(),
                              [&](const Known& known) {
                                return secondsBetween(known.seen, stamp) > options_.memory;
                              }),
               known_.end());
  for (const RoadOpening& opening : openings) {
    lookInto(hits, opening, stamp);
  }
}

void SideStreets::lookInto(const HitGrid& hits, const RoadOpening& opening, Stamp stamp) {
  const Pose2 from = opening.middle * Pose2(options_.start, 0.0, 0.0);
  for (const RoadSide side : {RoadSide::kLeft, RoadSide::kRight}) {
    const auto found = search_.search(hits, from, side);
    if (!found) {
      continue;
    }
    // The latest search has the most hits.
    known_.erase(std::remove_if(known_.begin(), known_.end(),
                                [&](const Known& known) { return exclude(known.border, *found); }),
                 known_.end());
    if (known_.size() < kMaxKnown) {
      known_.push_back({*found, opening.side, stamp});
    }
  }
}

std::vector<RoadBorder> SideStreets::borders(Stamp stamp) const {
  std::vector<RoadBorder> borders;
  for (const Known& known : known_) {
    const FoundBorder& found = known.border;
    RoadBorder border;
    border.side = known.of;
    border.side_street = true;
    border.probability = std::min(1.0, found.score);
    border.unseen_for = secondsBetween(known.seen, stamp);
    border.points = pointsOf(found, kPointStep);
    borders.push_back(border);
  }
  return borders;
}

void SideStreets::reset() {
  known_.clear();
  last_look_.reset();
}

}  // namespace datmo
