#include "datmo_fusion/slam/odometry_buffer.h"

#include <algorithm>
#include <iterator>

namespace datmo {

void OdometryBuffer::add(const OdometrySample& sample) {
  if (!samples_.empty() && sample.stamp <= samples_.back().stamp) {
    return;
  }
  samples_.push_back(sample);
  while (secondsBetween(samples_.front().stamp, sample.stamp) > memory_) {
    samples_.pop_front();
  }
}

std::optional<Pose2> OdometryBuffer::motion(Stamp from, Stamp to,
                                            const OdometryErrors& errors) const {
  const auto later = std::upper_bound(
      samples_.begin(), samples_.end(), from,
      [](Stamp stamp, const OdometrySample& sample) { return stamp < sample.stamp; });
  // The first sample also serves for the time just before it.
  auto sample = later == samples_.begin() ? later : std::prev(later);
  if (sample == samples_.end() || secondsBetween(from, sample->stamp) > longest_hold_) {
    return std::nullopt;
  }
  Pose2 motion;
  Stamp at = from;
  while (at < to) {
    const auto next = std::next(sample);
    const Stamp until = next == samples_.end() ? to : std::min(to, next->stamp);
    if (secondsBetween(sample->stamp, until) > longest_hold_) {
      return std::nullopt;
    }
    motion = motion * arc(errors.correct(sample->twist), secondsBetween(at, until));
    at = until;
    if (next == samples_.end()) {
      break;
    }
    sample = next;
  }
  return motion;
}

}  // namespace datmo
