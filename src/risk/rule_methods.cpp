// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/risk/rule_methods.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "datmo_fusion/common/perpendicular.h"
#include "datmo_fusion/common/square.h"
#include "datmo_fusion/risk/object_futures.h"

namespace datmo {

namespace {

/// m/s; bodies that approach more slowly do not close a gap.
constexpr double kClosing = 0.01;

Point2 velocityOf(const Track& track) { return track.state.segment<2>(2); }

/// Returns the path at constant velocity, at the times of another path.
BodyPath straightPath(const Track& track, const BodyPath& times) {
  BodyPath path{times.step, {}};
  for (std::size_t i = 0; i < times.poses.size(); ++i) {
    const double time = static_cast<double>(i) * times.step;
    path.poses.push_back(
        bodyPose(track.state.head<2>() + time * velocityOf(track), track.box.center.heading()));
  }
  return path;
}

ObjectRisk riskOf(const Track& track) {
  ObjectRisk risk;
  risk.id = track.id;
  risk.object_class = track.objectClass();
  risk.mode = likeliestMode(track);
  return risk;
}

/// Sets contact at `time` with this probability.
void setContact(ObjectRisk& risk, double time, double probability, const RuleOptions& options) {
  for (std::size_t i = 0; i < kRiskTimes; ++i) {
    risk.contact_probability[i] = time <= static_cast<double>(i + 1) ? probability : 0.0;
  }
  risk.early_ttc = time;
  risk.median_ttc = time;
  risk.time_to_brake = std::max(0.0, time - options.vehicle_time);
}

void setStrike(ObjectRisk& risk, const BodyMove& host, const BodyMove& other, double step) {
  risk.side = struckSide(host.from, host.size, other.from, other.size);
  const Point2 drift = (other.to.center - other.from.center) - (host.to.center - host.from.center);
  risk.strike_speed = drift.norm() / step;
  risk.contact = other.from.center;
}

BodyMove moveAt(const BodyPath& path, const BodySize& size, double time) {
  const auto i = std::min(static_cast<std::size_t>(time / path.step), path.poses.size() - 2);
  return {path.poses[i], path.poses[i + 1], size};
}

double brakingOf(ObjectClass object_class, const RuleOptions& options) {
  switch (object_class) {
    case ObjectClass::kPedestrian:
      return options.pedestrian_braking;
    case ObjectClass::kCyclist:
      return options.cyclist_braking;
    case ObjectClass::kUnknown:
    case ObjectClass::kVehicle:
    case ObjectClass::kPole:
      break;
  }
  return options.vehicle_braking;
}

/// A body's motion along the line to the other one.
struct Approach {
  double speed;         ///< m/s, toward the other; negative: away
  double response;      ///< m/s^2, in the response time
  double braking;       ///< m/s^2, after it
  double hard_braking;  ///< m/s^2, of one that moves away
};

/// How far a body advances toward the other, m: it accelerates toward it for the response time
/// (s), and then brakes; one that moves away may brake as hard as it can at once.
double advanceOf(const Approach& body, double time) {
  if (body.speed < 0.0) {
    return -square(body.speed) / (2.0 * body.hard_braking);
  }
  const double after = body.speed + body.response * time;
  return body.speed * time + 0.5 * body.response * square(time) +
         square(after) / (2.0 * body.braking);
}

struct Gap {
  double distance;      ///< m; not positive: the bodies overlap along this line
  double toward_other;  ///< m/s, of the host
  double toward_host;   ///< m/s, of the other
};

Gap gapAlong(const Point2& axis, double reach, const Point2& apart, const Point2& host,
             const Point2& other) {
  const double along = axis.dot(apart);
  const double side = along < 0.0 ? -1.0 : 1.0;
  return {std::abs(along) - reach, side * axis.dot(host), -side * axis.dot(other)};
}

}  // namespace

void RuleOptions::visit(OptionVisitor& visitor) {
  visitor.number({"host_radius", "m", "radius of the host's circle (thesis 5.3.5; our assumption)"},
                 host_radius, {0.1, 10.0});
  visitor.number({"growth", "1",
                  "growth of a vehicle's circle with each meter that it travels (thesis 5.3.5; our "
                  "assumption)"},
                 growth, {0.0, 1.0});
  visitor.number({"host_braking", "m/s^2",
                  "rss: deceleration that the host is certain to reach after the response time"},
                 host_braking, {0.1, 15.0});
}

ObjectRisk thesisRisk(const Track& track, const BodyPath& host, const RuleOptions& options) {
  ObjectRisk risk = riskOf(track);
  const bool pedestrian = risk.object_class == ObjectClass::kPedestrian;
  const double speed = velocityOf(track).norm();
  const double radius = pedestrian ? options.pedestrian_radius : options.vehicle_radius;
  const double growth = pedestrian ? 1.0 : options.growth;
  for (std::size_t i = 0; i < host.poses.size(); ++i) {
    const double time = static_cast<double>(i) * host.step;
    const Point2 gone = pedestrian ? Point2(0.0, 0.0) : Point2(time * velocityOf(track));
    const Point2 center = track.state.head<2>() + gone;
    const double reach = options.host_radius + radius + growth * speed * time;
    if ((center - host.poses[i].center).norm() <= reach) {
      const double reaction = options.driver_time + options.vehicle_time;
      const double left = host.duration() - reaction;
      const double share =
          time <= reaction || left <= 0.0 ? 1.0 : std::max(0.0, 1.0 - (time - reaction) / left);
      setContact(risk, time, std::pow(share, options.curve), options);
      const BodySize size = bodySize(track.box);
      setStrike(risk, moveAt(host, {options.host_radius, options.host_radius}, time),
                moveAt(straightPath(track, host), size, time), host.step);
      return risk;
    }
  }
  return risk;
}

ObjectRisk boxRisk(const Track& track, const BodyPath& host, const BodySize& host_size,
                   const RuleOptions& options) {
  ObjectRisk risk = riskOf(track);
  const BodyPath other = straightPath(track, host);
  const BodySize size = bodySize(track.box);
  if (const auto time = firstContact(host, host_size, other, size)) {
    setContact(risk, *time, 1.0, options);
    setStrike(risk, moveAt(host, host_size, *time), moveAt(other, size, *time), host.step);
  }
  return risk;
}

ObjectRisk rssRisk(const Track& track, const BodyPath& host, const BodySize& host_size,
                   const RuleOptions& options) {
  ObjectRisk risk = riskOf(track);
  const BodyPose& pose = host.poses.front();
  const BodyPose other = bodyPose(track.state.head<2>(), track.box.center.heading());
  const BodySize size = bodySize(track.box);
  const Point2 apart = other.center - pose.center;
  const auto reach = [&](const Point2& axis) { return reachAlong(axis, other, size); };
  const Point2 left = perpendicular(pose.direction);
  const Gap ahead = gapAlong(pose.direction, host_size.half_length + reach(pose.direction), apart,
                             host.velocity(0), velocityOf(track));
  const Gap aside = gapAlong(left, host_size.half_width + reach(left), apart, host.velocity(0),
                             velocityOf(track));
  const double braking = brakingOf(risk.object_class, options);
  const double time = options.response_time;
  const double safe_ahead =
      advanceOf({ahead.toward_other, options.response_acceleration, options.host_braking,
                 options.vehicle_braking},
                time) +
      advanceOf({ahead.toward_host, options.response_acceleration, options.host_braking, braking},
                time);
  const auto lateral = [&](double speed) {
    return advanceOf(
        {speed, options.lateral_acceleration, options.lateral_braking, options.lateral_braking},
        time);
  };
  const double safe_aside =
      options.lateral_margin + lateral(aside.toward_other) + lateral(aside.toward_host);
  if (ahead.distance >= std::max(0.0, safe_ahead) || aside.distance >= std::max(0.0, safe_aside)) {
    return risk;
  }
  const double closing = ahead.toward_other + ahead.toward_host;
  const double contact =
      closing > kClosing ? std::max(0.0, ahead.distance) / closing : host.duration();
  setContact(risk, std::min(contact, host.duration()), 1.0, options);
  risk.time_to_brake = 0.0;  // the safe distances already include the response time
  risk.side = struckSide(pose, host_size, other, size);
  risk.strike_speed = (velocityOf(track) - host.velocity(0)).norm();
  risk.contact = other.center;
  return risk;
}

}  // namespace datmo
