// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/velocity_wait.h"

#include <cstddef>
#include <string>
#include <utility>

namespace datmo {

namespace {

/// One second of a fast camera: longer than matching takes.
constexpr std::size_t kMaxOfEach = 50;

}  // namespace

void VelocityWaitOptions::visit(OptionVisitor& visitor) {
  visitor.number({"max_wait", "s",
                  "longest time that the objects of a cloud wait for the points with velocity of "
                  "its stamp, if these are published; object_fusion waits for the objects"},
                 max_wait, {0.0, 2.0});
  visitor.number(
      {"silent_after", "s",
       "a cloud newer than the last points with velocity by more than this does not wait"},
      silent_after, {0.02, 10.0});
}

VelocityWait::VelocityWait(const Checked<VelocityWaitOptions>& options, StageMonitor& monitor)
    : options_(*options), monitor_(monitor) {}

void VelocityWait::addPoints(Stamp stamp, std::vector<PointVelocity> points) {
  const bool first = !newest_;
  newest_ = stamp;
  if (served_ && stamp <= *served_) {
    // The first points could not be expected.
    if (!first) {
      monitor_.dropped(InputError(
          "late_velocities",
          "points with velocity arrived after their cloud had waited for velocity/max_wait = " +
              std::to_string(options_.max_wait) + " s: expected earlier; left out"));
    }
    return;
  }
  points_.push_back({stamp, std::move(points)});
  if (points_.size() > kMaxOfEach) {
    points_.pop_front();
    monitor_.dropped(InputError("velocities_without_cloud",
                                "more than " + std::to_string(kMaxOfEach) +
                                    " lists of points with velocity wait for their clouds: "
                                    "expected clouds with the same stamps, dropped the oldest"));
  }
}

void VelocityWait::addObjects(ObjectList list, double seconds) {
  const bool waits = speaks(list.stamp);
  waiting_.push_back({std::move(list), seconds, waits, std::nullopt});
}

bool VelocityWait::speaks(Stamp now) const {
  return newest_ && secondsBetween(*newest_, now) < options_.silent_after;
}

bool VelocityWait::mayGoOn(const Waiting& waiting) const {
  const Stamp stamp = waiting.list.stamp;
  return !waiting.waits || (newest_ && *newest_ >= stamp) || waiting_.size() > kMaxOfEach ||
         secondsBetween(stamp, waiting_.back().list.stamp) >= options_.max_wait;
}

std::optional<VelocityWait::Served> VelocityWait::next() {
  return waiting_.empty() || !mayGoOn(waiting_.front()) ? std::nullopt
                                                        : std::make_optional(serveOldest());
}

std::optional<VelocityWait::Served> VelocityWait::next(Stamp now) {
  for (Waiting& waiting : waiting_) {
    waiting.since = waiting.since.value_or(now);
  }
  if (waiting_.empty()) {
    return std::nullopt;
  }
  const double waited = secondsBetween(*waiting_.front().since, now);
  return waited >= options_.max_wait ? std::make_optional(serveOldest()) : next();
}

VelocityWait::Served VelocityWait::serveOldest() {
  Waiting oldest = std::move(waiting_.front());
  waiting_.pop_front();
  served_ = oldest.list.stamp;
  while (!points_.empty() && points_.front().stamp < *served_) {
    points_.pop_front();
    monitor_.dropped(
        InputError("velocities_without_cloud",
                   "points with velocity without a cloud: expected one of the same stamp"));
  }
  Served result{std::move(oldest.list), oldest.seconds, std::nullopt};
  if (!points_.empty() && points_.front().stamp == *served_) {
    result.points = std::move(points_.front().points);
    points_.pop_front();
  } else if (oldest.waits) {
    monitor_.warned(InputError("no_velocities",
                               "no points with velocity of the cloud's stamp: expected them within "
                               "velocity/max_wait = " +
                                   std::to_string(options_.max_wait) +
                                   " s; its objects continue without velocity"));
  }
  return result;
}

void VelocityWait::clear() {
  points_.clear();
  waiting_.clear();
  newest_.reset();
  served_.reset();
}

}  // namespace datmo
