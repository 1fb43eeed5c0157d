// SPDX-License-Identifier: BSD-3-Clause
#include "contact_futures.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "datmo_fusion/common/quantile.h"

namespace datmo {

namespace {

/// Fewer possible futures than this give no probability: then those in which the bodies already
/// overlap count as well.
constexpr std::size_t kMinPossible = 16;

constexpr double kEarly = 0.05;
constexpr double kMedian = 0.5;

/// Returns the side with most contacts; the first in the order of StruckSide if several have as
/// many.
StruckSide sideOf(const std::vector<FutureContact>& contacts) {
  std::array<int, 5> counts{};
  for (const FutureContact& contact : contacts) {
    ++counts[static_cast<std::size_t>(contact.side)];
  }
  return static_cast<StruckSide>(std::max_element(counts.begin(), counts.end()) - counts.begin());
}

FutureContact contactAt(const BodyMove& host, const BodyMove& object, double share, double step) {
  const Point2 drift =
      (object.to.center - object.from.center) - (host.to.center - host.from.center);
  const BodyPose at = object.at(share);
  FutureContact contact;
  contact.time = share * step;
  contact.side = struckSide(host.at(share), host.size, at, object.size);
  contact.speed = drift.norm() / step;
  contact.position = at.center;
  return contact;
}

/// Returns a path of twice the duration, continued as it ends.
BodyPath continued(const BodyPath& path) {
  BodyPath result = path;
  const std::size_t steps = path.poses.size() - 1;
  if (steps == 0) {
    return result;
  }
  const Point2 step = path.velocity(steps - 1) * path.step;
  for (std::size_t i = 0; i < steps; ++i) {
    BodyPose next = result.poses.back();
    next.center += step;
    result.poses.push_back(next);
  }
  return result;
}

/// Whether the other body is stationary or moves in the host's direction, so that the host has to
/// stop or match its speed; oncoming traffic would also strike a stationary host.
bool isPursued(const Encounter& encounter) {
  return encounter.host.poses.size() < 2 ||
         encounter.host.velocity(0).dot(encounter.other.velocity(0)) >= 0.0;
}

}  // namespace

std::optional<FutureContact> contactOf(const BodyPath& host, const BodySize& host_size,
                                       const ObjectFutures& object, const BodySize& size,
                                       std::size_t future) {
  const double host_radius = host_size.radius();
  const double radius = size.radius();
  ObjectFutures::State state = object.begin(future);
  for (std::size_t i = 0; i + 1 < host.poses.size(); ++i) {
    const Point2 from = state.position;
    const double heading = state.heading;
    object.advance(state, future, i);
    if (circlesMeet({host.poses[i].center, host.poses[i + 1].center, host_radius},
                    {from, state.position, radius})) {
      const BodyMove host_move{host.poses[i], host.poses[i + 1], host_size};
      const BodyMove move{bodyPose(from, heading), bodyPose(state.position, state.heading), size};
      if (const auto share = firstContact(host_move, move)) {
        FutureContact contact = contactAt(host_move, move, *share, host.step);
        contact.time += static_cast<double>(i) * host.step;
        contact.future = future;
        return contact;
      }
    }
  }
  return std::nullopt;
}

FutureContact contactWith(const StandingPoints::Contact& contact, const BodyPath& host,
                          const BodySize& host_size, std::size_t future) {
  const auto i =
      std::min(static_cast<std::size_t>(contact.time / host.step), host.poses.size() - 2);
  const double share = contact.time / host.step - static_cast<double>(i);
  const BodyMove move{host.poses[i], host.poses[i + 1], host_size};
  return {future, contact.time,
          struckSide(move.at(share), host_size, bodyPose(contact.point, 0.0), BodySize()),
          host.velocity(i).norm(), contact.point};
}

std::size_t leaveOutTouching(std::vector<FutureContact>& contacts, std::size_t futures) {
  const auto touches = [](const FutureContact& contact) { return contact.time <= 0.0; };
  const auto touching =
      static_cast<std::size_t>(std::count_if(contacts.begin(), contacts.end(), touches));
  if (futures - touching < kMinPossible) {
    return futures;
  }
  contacts.erase(std::remove_if(contacts.begin(), contacts.end(), touches), contacts.end());
  return futures - touching;
}

void summarize(std::vector<FutureContact>& contacts, std::size_t futures, double weight,
               ObjectRisk& risk) {
  if (contacts.empty()) {
    return;
  }
  std::stable_sort(contacts.begin(), contacts.end(),
                   [](const FutureContact& a, const FutureContact& b) { return a.time < b.time; });
  std::vector<double> times;
  std::vector<double> speeds;
  for (const FutureContact& contact : contacts) {
    times.push_back(contact.time);
    speeds.push_back(contact.speed);
  }
  for (std::size_t i = 0; i < kRiskTimes; ++i) {
    const auto within =
        std::upper_bound(times.begin(), times.end(), static_cast<double>(i + 1)) - times.begin();
    risk.contact_probability[i] =
        weight * static_cast<double>(within) / static_cast<double>(futures);
  }
  risk.early_ttc = quantile(times, kEarly);
  risk.median_ttc = quantile(times, kMedian);
  risk.side = sideOf(contacts);
  risk.strike_speed = quantile(speeds, kMedian);
  risk.contact = contacts[(contacts.size() - 1) / 2].position;
}

void setCriticality(const Encounter& met, const HostVehicleOptions& vehicle, ObjectRisk& risk) {
  // Braking that only delays contact does not avoid it: a stationary object reached within T at
  // speed v requires at least v / (2 T), which stops within 2 T.
  const bool pursued = isPursued(met);
  const BodyPath host = pursued ? continued(met.host) : met.host;
  const BodyPath other = pursued ? continued(met.other) : met.other;
  const Encounter encounter{host, met.host_size, other, met.other_size};
  risk.time_to_brake = timeToBrake(encounter, vehicle.max_braking);
  risk.brake_threat = brakeThreat(encounter, vehicle.max_braking);
  risk.steer_threat = steerThreat(encounter, vehicle.max_lateral);
}

}  // namespace datmo
