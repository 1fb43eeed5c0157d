// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/risk/criticality.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "datmo_fusion/common/perpendicular.h"

namespace datmo {

namespace {

/// Bisections of an interval: a value is found to 1.6 % of it.
constexpr int kHalvings = 6;

/// m/s; below this, a path does not define a heading.
constexpr double kMoving = 0.1;

bool touch(const Encounter& encounter, const BodyPath& host) {
  return firstContact(host, encounter.host_size, encounter.other, encounter.other_size).has_value();
}

/// Returns where `holds` becomes true between `from`, where it is false, and `to`, where it is
/// true: the end at which it is true.
template <typename Holds>
double firstWhere(double from, double to, const Holds& holds) {
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (from + to);
    (holds(middle) ? to : from) = middle;
  }
  return to;
}

/// Returns the arc length up to each pose, m.
std::vector<double> lengthsOf(const BodyPath& path) {
  std::vector<double> lengths{0.0};
  for (std::size_t i = 0; i + 1 < path.poses.size(); ++i) {
    lengths.push_back(lengths.back() + path.velocity(i).norm() * path.step);
  }
  return lengths;
}

/// Returns the pose on a path at an arc length within it.
BodyPose poseAt(const BodyPath& path, const std::vector<double>& lengths, double length) {
  const auto next = std::upper_bound(lengths.begin(), lengths.end(), length);
  if (next == lengths.end()) {
    return path.poses.back();
  }
  const auto i = static_cast<std::size_t>(next - lengths.begin()) - 1;
  const BodyMove move{path.poses[i], path.poses[i + 1], {}};
  return move.at((length - lengths[i]) / (lengths[i + 1] - lengths[i]));
}

/// Returns the deceleration (or lateral acceleration) that avoids contact, as a multiple of the
/// vehicle's maximum; kHopeless if more is required.
template <typename Avoids>
double threat(const Avoids& avoids) {
  if (avoids(0.0)) {
    return 0.0;
  }
  return avoids(kHopeless) ? firstWhere(0.0, kHopeless, avoids) : kHopeless;
}

}  // namespace

BodyPath braked(const BodyPath& host, double start, double deceleration) {
  const std::vector<double> lengths = lengthsOf(host);
  const auto index = std::min(static_cast<std::size_t>(start / host.step), host.poses.size() - 1);
  const double speed = host.velocity(index).norm();
  const double start_length =
      lengths[index] + speed * (start - static_cast<double>(index) * host.step);
  const double stops_after =
      deceleration > 0.0 ? speed / deceleration : std::numeric_limits<double>::infinity();
  BodyPath path{host.step, {}};
  path.poses.reserve(host.poses.size());
  for (std::size_t i = 0; i < host.poses.size(); ++i) {
    const double since = static_cast<double>(i) * host.step - start;
    if (since <= 0.0) {
      path.poses.push_back(host.poses[i]);
      continue;
    }
    const double braking = std::min(since, stops_after);
    const double driven = speed * braking - 0.5 * deceleration * braking * braking;
    path.poses.push_back(poseAt(host, lengths, start_length + driven));
  }
  return path;
}

BodyPath steered(const BodyPath& host, double lateral) {
  BodyPath path = host;
  for (std::size_t i = 1; i < path.poses.size(); ++i) {
    const double time = static_cast<double>(i) * host.step;
    const Point2 velocity = host.velocity(i - 1);
    const double speed = velocity.norm();
    if (speed < kMoving) {
      path.poses[i] = path.poses[i - 1];
      continue;
    }
    const BodyPose& own = host.poses[i];
    const double turn = std::atan2(lateral * time, speed);
    const bool reverses = velocity.dot(own.direction) < 0.0;
    path.poses[i] =
        bodyPose(own.center + 0.5 * lateral * time * time * perpendicular(own.direction),
                 own.heading + (reverses ? -turn : turn));
  }
  return path;
}

double timeToBrake(const Encounter& encounter, double max_braking) {
  const auto contact =
      firstContact(encounter.host, encounter.host_size, encounter.other, encounter.other_size);
  if (!contact) {
    return encounter.host.duration();
  }
  const auto too_late = [&](double start) {
    return touch(encounter, braked(encounter.host, start, max_braking));
  };
  if (too_late(0.0)) {
    return 0.0;
  }
  return firstWhere(0.0, *contact, too_late);
}

double brakeThreat(const Encounter& encounter, double max_braking) {
  return threat([&](double share) {
    return !touch(encounter, braked(encounter.host, 0.0, share * max_braking));
  });
}

double steerThreat(const Encounter& encounter, double max_lateral) {
  const auto to_side = [&](double side) {
    return threat([&](double share) {
      return !touch(encounter, steered(encounter.host, side * share * max_lateral));
    });
  };
  return std::min(to_side(1.0), to_side(-1.0));
}

double postEncroachmentTime(const Encounter& encounter) {
  const double reach = encounter.host_size.radius() + encounter.other_size.radius();
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < encounter.host.poses.size(); ++i) {
    for (std::size_t j = 0; j < encounter.other.poses.size(); ++j) {
      const double between =
          std::abs(static_cast<double>(i) - static_cast<double>(j)) * encounter.host.step;
      const BodyPose& host = encounter.host.poses[i];
      const BodyPose& other = encounter.other.poses[j];
      if (between < least && (host.center - other.center).squaredNorm() <= reach * reach &&
          separation(host, encounter.host_size, other, encounter.other_size).gap <= 0.0) {
        least = between;
      }
    }
  }
  return least;
}

}  // namespace datmo
