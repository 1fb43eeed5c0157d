// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/road/intersection_detector.h"

#include <algorithm>
#include <cmath>

namespace datmo {

namespace {

/// A station whose probability is higher has a border.
constexpr double kSureBorder = 0.65;

/// Distance between two observations of the sides that are taken to be independent, m.
constexpr double kEvidenceLength = 1.5;

/// Upper limit of the log odds of one station: its beams have errors in common.
constexpr double kStationLimit = 2.0;

/// Distance after which the border that a side had counts for 37 % of its length, m.
constexpr double kRoadMemory = 60.0;

/// Mean distance between two intersections in a town, m.
constexpr double kRoadLength = 150.0;

/// Mean distance through an intersection, m.
constexpr double kCrossingLength = 20.0;

/// Length of which half are stations with a border before a side has one: a single one is none, m.
constexpr double kMinBorder = 5.0;

/// Border that a side of a road had of late: what is open after less is a car park, m.
constexpr double kMinRoad = 15.0;

double logOdds(double probability) { return std::log(probability / (1.0 - probability)); }

int stationsOf(const SidePresence& side) { return static_cast<int>(side.probability.size()); }

double arcLengthOf(const SidePresence& side, int station) {
  return side.first_station + station * side.station_length;
}

/// The station at an arc length, or the nearest one.
int stationAt(const SidePresence& side, double arc_length) {
  const double station = std::round((arc_length - side.first_station) / side.station_length);
  return static_cast<int>(std::clamp(station, 0.0, stationsOf(side) - 1.0));
}

/// Both sides bound the road, or one does: on the road. One open side is enough for a junction.
double combined(double left, double right) {
  if (left <= 0.0 && right <= 0.0) {
    return left + right;
  }
  return std::max(left, 0.0) + std::max(right, 0.0);
}

}  // namespace

void IntersectionDetectorOptions::visit(OptionVisitor& visitor) {
  visitor.number({"min_opening", "m",
                  "without a border: a street of 6 m or more, whose corners are rounded; yards and "
                  "gaps between cars are narrower"},
                 min_opening, {1.0, 50.0});
  visitor.number({"max_opening", "m",
                  "since the last border: behind it the border is lost, or it was no road but an "
                  "open space"},
                 max_opening, {1.0, 500.0});
  visitor.number({"enter_above", "1", "probability from which on the vehicle is at one"},
                 enter_above, {0.01, 0.99});
  visitor.number({"leave_below", "1", "probability from which on it is at one no more"},
                 leave_below, {0.01, 0.99});
}

void IntersectionDetectorOptions::check() const {
  if (leave_below > enter_above) {
    throw OptionError("leave_below is " + toText(leave_below) + ": expected at most enter_above, " +
                      toText(enter_above));
  }
  if (min_opening > max_opening) {
    throw OptionError("min_opening is " + toText(min_opening) + ": expected at most max_opening, " +
                      toText(max_opening));
  }
}

IntersectionDetector::IntersectionDetector(const Checked<IntersectionDetectorOptions>& options)
    : options_(*options) {}

/// Whether a border reaches to (`toward` -1) or begins at (1) a station: it has one, and half of
/// those before or behind it.
bool IntersectionDetector::isBorder(const SidePresence& side, int station, int toward) const {
  const auto hasBorder = [&](int i) {
    return side.probability[static_cast<std::size_t>(i)] > kSureBorder;
  };
  if (!hasBorder(station)) {
    return false;
  }
  const int stations = std::max(1, static_cast<int>(std::lround(kMinBorder / side.station_length)));
  int with_border = 0;
  for (int i = 0; i < stations; ++i) {
    const int at = station + toward * i;
    with_border += at >= 0 && at < stationsOf(side) && hasBorder(at) ? 1 : 0;
  }
  return 2 * with_border >= stations;
}

double IntersectionDetector::meanOpenness(const SidePresence& side, double arc_length, double begin,
                                          double end) const {
  const int first = stationAt(side, std::max(begin, arc_length - options_.min_opening));
  const int last = stationAt(side, std::min(end, arc_length + options_.min_opening));
  double sum = 0.0;
  for (int i = first; i <= last; ++i) {
    const double open = 1.0 - side.probability[static_cast<std::size_t>(i)];
    sum += std::clamp(logOdds(open), -kStationLimit, kStationLimit);
  }
  return sum / (last - first + 1);
}

void IntersectionDetector::pass(const SidePresence& side, double arc_length, double step,
                                PassedSide& passed) const {
  const bool has_border = !side.probability.empty() && side.station_length > 0.0 &&
                          isBorder(side, stationAt(side, arc_length), -1);
  passed.bordered = passed.bordered * std::exp(-step / kRoadMemory) + (has_border ? step : 0.0);
}

double IntersectionDetector::openness(const SidePresence& side, double arc_length,
                                      PassedSide& passed) const {
  BorderEnd& border_end = passed.border_end;
  if (side.probability.empty() || !(side.station_length > 0.0)) {
    return 0.0;
  }
  const int here = stationAt(side, arc_length);
  for (int i = here; i >= 0; --i) {
    if (isBorder(side, i, -1)) {
      border_end = std::max(border_end.value_or(arcLengthOf(side, i)), arcLengthOf(side, i));
      break;
    }
  }
  // A few parked cars are no road.
  const bool is_road = passed.bordered >= kMinRoad;
  if (!border_end || arc_length - *border_end > options_.max_opening || !is_road) {
    return 0.0;
  }
  const double half_station = 0.5 * side.station_length;
  const double begin = *border_end + half_station;
  int next = here;
  while (next < stationsOf(side) && !isBorder(side, next, 1)) {
    ++next;
  }
  const bool ends = next < stationsOf(side);
  const double end =
      arcLengthOf(side, std::min(next, stationsOf(side) - 1)) + (ends ? -1.0 : 1.0) * half_station;
  if (arc_length <= begin || (ends && end - begin < options_.min_opening)) {
    return -kStationLimit;
  }
  return end - begin < options_.min_opening
             ? 0.0
             : meanOpenness(side, arc_length, begin + half_station, end - half_station);
}

void IntersectionDetector::update(const BorderPresence& presence) {
  const double arc_length = presence.arc_length;
  if (!std::isfinite(arc_length)) {
    return;
  }
  if (last_arc_length_ && arc_length < *last_arc_length_) {
    reset();
  }
  const double step = arc_length - last_arc_length_.value_or(arc_length);
  last_arc_length_ = arc_length;
  pass(presence.left, arc_length, step, left_);
  pass(presence.right, arc_length, step, right_);
  const double evidence = combined(openness(presence.left, arc_length, left_),
                                   openness(presence.right, arc_length, right_));
  const double enter_rate = 1.0 / kRoadLength;
  const double rate = enter_rate + 1.0 / kCrossingLength;
  const double usual = enter_rate / rate;
  const double before = usual + (probability_ - usual) * std::exp(-rate * step);
  // One observation, however far the step: more would be of stations that were not observed.
  const double looks = std::min(1.0, step / kEvidenceLength);
  const double ratio = std::exp(evidence * looks);
  probability_ = before * ratio / (before * ratio + 1.0 - before);
  at_intersection_ =
      probability_ >= (at_intersection_ ? options_.leave_below : options_.enter_above);
}

void IntersectionDetector::reset() {
  last_arc_length_.reset();
  left_ = {};
  right_ = {};
  probability_ = 0.0;
  at_intersection_ = false;
}

}  // namespace datmo
