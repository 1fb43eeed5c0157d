// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/device/clock_estimator.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace datmo {

namespace {

/// s; interval of whose messages only the earliest is used.
constexpr double kBin = 0.5;

}  // namespace

void ClockOptions::visit(OptionVisitor& visitor) {
  visitor.number(
      {"window", "s", "time window of the messages by which the device's clock is estimated"},
      window, {1.0, 3600.0});
  visitor.number({"settle", "s", "messages over a shorter time do not determine its drift"}, settle,
                 {1.0, 3600.0});
  visitor.number({"max_drift", "1",
                  "largest drift of a clock (a crystal's 100 ppm, and as much again for the "
                  "computer's, with a margin)"},
                 max_drift, {0.0, 0.01});
  visitor.number({"step", "s", "a message that deviates by more indicates that a clock was set"},
                 step, {0.01, 10.0});
  visitor.number({"confirm", "s", "messages that stay late for longer were not merely delayed"},
                 confirm, {0.0, 10.0});
}

Stamp ClockEstimator::add(double device, Stamp arrival) {
  if (!origin_) {
    begin(device, arrival);
    return arrival;
  }
  const double host = secondsBetween(*origin_, arrival);
  const Point point{device - device_origin_, host - (device - device_origin_)};
  const double off = point.delay - lineAt(point.time);
  if (point.time < newest_ || off < -options_.step) {
    step(device, arrival);
    return arrival;
  }
  if (off > options_.step) {
    late_since_ = late_since_.value_or(host);
    if (host - *late_since_ >= options_.confirm) {
      step(device, arrival);
      return arrival;
    }
  } else {
    late_since_.reset();
    keep(point);
    fit();
  }
  newest_ = point.time;
  return *origin_ + (point.time + lineAt(point.time));
}

void ClockEstimator::begin(double device, Stamp arrival) {
  origin_ = arrival;
  device_origin_ = device;
  newest_ = 0.0;
  intercept_ = 0.0;
  points_ = {Point()};
  late_since_.reset();
}

void ClockEstimator::step(double device, Stamp arrival) {
  ++steps_;
  begin(device, arrival);
}

void ClockEstimator::restart() {
  origin_.reset();
  points_.clear();
  late_since_.reset();
}

std::optional<double> ClockEstimator::offset() const {
  if (!origin_) {
    return std::nullopt;
  }
  return origin_->seconds() - device_origin_ + lineAt(newest_);
}

void ClockEstimator::keep(const Point& point) {
  Point& last = points_.back();
  if (point.time - last.time >= kBin) {
    points_.push_back(point);
  } else if (point.delay - drift_ * point.time < last.delay - drift_ * last.time) {
    // The bin keeps its start, so that early messages do not extend it forever.
    last.delay = point.delay - drift_ * (point.time - last.time);
  }
  while (point.time - points_.front().time > options_.window) {
    points_.pop_front();
  }
}

void ClockEstimator::fit() {
  if (points_.back().time - points_.front().time >= options_.settle) {
    drift_ = std::clamp(hullSlope(), -options_.max_drift, options_.max_drift);
  }
  intercept_ = std::numeric_limits<double>::infinity();
  for (const Point& point : points_) {
    intercept_ = std::min(intercept_, point.delay - drift_ * point.time);
  }
}

double ClockEstimator::hullSlope() const {
  std::vector<Point> hull;
  const auto slope = [](const Point& from, const Point& to) {
    return (to.delay - from.delay) / (to.time - from.time);
  };
  double mean = 0.0;
  for (const Point& point : points_) {
    mean += point.time / static_cast<double>(points_.size());
    while (hull.size() >= 2 &&
           slope(hull[hull.size() - 2], hull.back()) >= slope(hull.back(), point)) {
      hull.pop_back();
    }
    hull.push_back(point);
  }
  std::size_t end = 1;
  while (end + 1 < hull.size() && hull[end].time < mean) {
    ++end;
  }
  return slope(hull[end - 1], hull[end]);
}

}  // namespace datmo
