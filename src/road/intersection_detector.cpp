// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/road/intersection_detector.h"

#include <algorithm>
#include <cmath>

namespace datmo {

namespace {

/// Distance after which a road's earlier borders count for 37 % of their length, m.
constexpr double kRoadMemory = 60.0;

/// Mean distance between two intersections in a town, m.
constexpr double kRoadLength = 150.0;

/// Mean distance through an intersection, m.
constexpr double kCrossingLength = 20.0;

/// Branches of an intersection, including the vehicle's own road in both directions.
constexpr int kMinBranches = 3;

}  // namespace

void IntersectionDetectorOptions::visit(OptionVisitor& visitor) {
  visitor.number(
      {"seen_on_road", "1", "probability that three streets are seen on a road, which has two"},
      seen_on_road, {0.001, 0.99});
  visitor.number(
      {"min_road", "m",
       "length of border that the road had recently: with less, it is a parking lot or a square"},
      min_road, {0.0, 50.0});
  visitor.number(
      {"leave_below", "1", "probability below which the vehicle is no longer at an intersection"},
      leave_below, {0.01, 0.99});
}

void IntersectionDetectorOptions::check() const {
  if (leave_below > enter_above) {
    throw OptionError("leave_below is " + toText(leave_below) + ": expected at most " +
                      toText(enter_above) + ", from which the vehicle is at an intersection");
  }
  if (seen_on_road >= seen_at_intersection) {
    throw OptionError("seen_on_road is " + toText(seen_on_road) + ": expected less than " +
                      toText(seen_at_intersection) + ", at an intersection");
  }
}

IntersectionDetector::IntersectionDetector(const Checked<IntersectionDetectorOptions>& options)
    : options_(*options) {}

bool IntersectionDetector::isDue(double arc_length) const {
  return !last_arc_length_ || arc_length < *last_arc_length_ ||
         arc_length >= *last_arc_length_ + options_.evidence_length;
}

void IntersectionDetector::update(const IntersectionObservation& observation) {
  const double arc_length = observation.arc_length;
  if (!std::isfinite(arc_length)) {
    return;
  }
  if (last_arc_length_ && arc_length < *last_arc_length_) {
    reset();
  }
  const double step = arc_length - last_arc_length_.value_or(arc_length);
  last_arc_length_ = arc_length;
  bordered_ = bordered_ * std::exp(-step / kRoadMemory) + (observation.bordered ? step : 0.0);
  const bool seen = observation.branches >= kMinBranches && bordered_ >= options_.min_road;
  const double at = options_.seen_at_intersection;
  const double elsewhere = options_.seen_on_road;
  const double ratio = seen ? at / elsewhere : (1.0 - at) / (1.0 - elsewhere);
  const double enter_rate = 1.0 / kRoadLength;
  const double rate = enter_rate + 1.0 / kCrossingLength;
  const double usual = enter_rate / rate;
  const double before = usual + (probability_ - usual) * std::exp(-rate * step);
  // A step counts at most as one observation, a shorter one as a fraction of it.
  const double counted = std::pow(ratio, std::min(1.0, step / options_.evidence_length));
  probability_ = before * counted / (before * counted + 1.0 - before);
  at_intersection_ =
      probability_ >= (at_intersection_ ? options_.leave_below : options_.enter_above);
}

void IntersectionDetector::reset() {
  last_arc_length_.reset();
  bordered_ = 0.0;
  probability_ = 0.0;
  at_intersection_ = false;
}

}  // namespace datmo
