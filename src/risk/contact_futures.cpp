// SPDX-License-Identifier: BSD-3-Clause
#include "contact_futures.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "datmo_fusion/common/quantile.h"

namespace datmo {

namespace {

constexpr double kEarly = 0.05;
constexpr double kMedian = 0.5;

/// The side of most contacts; of as many the first in the order of StruckSide.
StruckSide sideOf(const std::vector<FutureContact>& contacts) {
  std::array<int, 5> counts{};
  for (const FutureContact& contact : contacts) {
    ++counts[static_cast<std::size_t>(contact.side)];
  }
  return static_cast<StruckSide>(std::max_element(counts.begin(), counts.end()) - counts.begin());
}

/// A path, continued as it ends for as long again. Braking that only puts contact off avoids none:
/// what is met within T at speed v needs v / (2 T) at least, which stops within 2 T.
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

}  // namespace

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
  const Encounter encounter{continued(met.host), met.host_size, continued(met.other),
                            met.other_size};
  risk.time_to_brake = timeToBrake(encounter, vehicle.max_braking);
  risk.brake_threat = brakeThreat(encounter, vehicle.max_braking);
  risk.steer_threat = steerThreat(encounter, vehicle.max_lateral);
}

}  // namespace datmo
