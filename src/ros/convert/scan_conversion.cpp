// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/convert/scan_conversion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "message_parts.h"

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/common/physical_bounds.h"
#include "datmo_fusion/ros/stage/input_error.h"
#include "datmo_fusion/ros/stage/stamp_check.h"

namespace datmo {

namespace {

/// A beam without return (REP 117).
constexpr float kNoReturn = std::numeric_limits<float>::infinity();

template <typename Message>
void checkGeometry(const Message& message) {
  for (const float angle : {message.angle_min, message.angle_max, message.angle_increment}) {
    if (!(std::abs(angle) <= kMaxBearing)) {
      throw InputError("bad_geometry", "scan with an angle of " + std::to_string(angle) +
                                           " rad: expected angles within two turns");
    }
  }
  for (const float range : {message.range_min, message.range_max}) {
    if (!std::isfinite(range)) {
      throw InputError("bad_geometry", "scan with a range limit of " + std::to_string(range) +
                                           ": expected a finite one");
    }
  }
  if (message.angle_increment == 0.0F) {
    throw InputError("bad_geometry", "scan with an angle increment of 0: expected another value");
  }
  if (message.range_min < 0.0F || message.range_max <= message.range_min) {
    throw InputError("bad_geometry", "scan with ranges from " + std::to_string(message.range_min) +
                                         " to " + std::to_string(message.range_max) +
                                         " m: expected 0 <= range_min < range_max");
  }
}

template <typename Message>
void checkSize(const Message& message) {
  if (message.ranges.empty()) {
    throw InputError("empty_scan", "scan without beams: expected at least one");
  }
  if (message.ranges.size() > kMaxBeams) {
    throw InputError("wrong_size", "scan with " + std::to_string(message.ranges.size()) +
                                       " beams: expected at most " + std::to_string(kMaxBeams));
  }
  const double steps =
      (static_cast<double>(message.angle_max) - message.angle_min) / message.angle_increment;
  const double expected = std::round(steps) + 1.0;
  if (std::abs(static_cast<double>(message.ranges.size()) - expected) > 1.0) {
    throw InputError("wrong_size", "scan with " + std::to_string(message.ranges.size()) +
                                       " beams: expected " + std::to_string(expected) +
                                       " from its angles");
  }
}

/// What is wrong with the time increment; NaN never passes, because comparisons with it are false.
template <typename Message>
std::optional<InputError> faultOfTimes(const Message& message, double max_sweep) {
  const double sweep =
      static_cast<double>(message.time_increment) * static_cast<double>(message.ranges.size() - 1);
  if (message.time_increment >= 0.0F && sweep <= max_sweep) {
    return std::nullopt;
  }
  return InputError("bad_beam_times",
                    "scan with " + std::to_string(message.ranges.size()) +
                        " beams and a time increment of " + std::to_string(message.time_increment) +
                        " s: expected 0 or more, and at most " + std::to_string(max_sweep) +
                        " s for all beams; assumes that they were measured at once");
}

/// NaN is never valid, because comparisons with it are false. Nor is 0, which drivers use for "no
/// measurement", even if range_min is 0.
bool isHit(float range, float range_min, float reach) {
  return range > 0.0F && range >= range_min && range < reach;
}

/// Also `reach` itself, which many drivers report instead of +inf (REP 117).
bool isNoReturn(float range, float reach) { return range >= reach; }

float rangeOf(float range, float /*range_min*/, float /*reach*/) { return range; }

/// The nearest valid echo; without one, no return if there was no echo or an echo says so.
float rangeOf(const sensor_msgs::LaserEcho& beam, float range_min, float reach) {
  float nearest = kNoReturn;
  bool no_return = beam.echoes.empty();
  for (const float echo : beam.echoes) {
    if (isHit(echo, range_min, reach)) {
      nearest = std::min(nearest, echo);
    }
    no_return = no_return || isNoReturn(echo, reach);
  }
  const bool hit = nearest != kNoReturn;
  return hit || no_return ? nearest : std::numeric_limits<float>::quiet_NaN();
}

/// The range (m) up to which an echo counts as a hit.
float reachOf(float range_max) { return std::min(range_max, static_cast<float>(kMaxReach)); }

Ray rayAt(double bearing, double range, const ScannerMount& mount) {
  Ray ray;
  const Pose2& scanner = mount.scanner_in_base;
  ray.origin = scanner.position();
  ray.end = scanner * Point2(range * std::cos(bearing), range * std::sin(bearing));
  ray.range = range;
  ray.bearing = bearing;
  return ray;
}

template <typename Message>
ScanField fieldOf(const Message& message, const ScannerMount& mount, double time_increment,
                  const ScanConversionOptions& options) {
  const double side = mount.upside_down ? -1.0 : 1.0;
  ScanField field;
  field.first_bearing = side * message.angle_min;
  field.beam_spacing = side * message.angle_increment;
  field.beams = static_cast<std::uint32_t>(message.ranges.size());
  field.min_range = message.range_min;
  field.range = reachOf(message.range_max);
  field.free_range = std::min(options.free_range, field.range);
  field.beam_time = time_increment;
  return field;
}

template <typename Message>
ConvertedScan convert(const Message& message, const ScannerMount& mount,
                      const ScanConversionOptions& options) {
  checkGeometry(message);
  checkSize(message);
  ConvertedScan converted;
  converted.unusable_times = faultOfTimes(message, options.max_sweep);
  const double time_increment =
      converted.unusable_times ? 0.0 : static_cast<double>(message.time_increment);
  Scan& scan = converted.scan;
  scan.stamp = toStamp(message.header.stamp);
  scan.scanner_in_base = mount.scanner_in_base;
  scan.field = fieldOf(message, mount, time_increment, options);
  scan.rays.reserve(message.ranges.size());
  const float reach = reachOf(message.range_max);
  const double free_range = scan.field.free_range;
  for (std::uint32_t beam = 0; beam < message.ranges.size(); ++beam) {
    const float range = rangeOf(message.ranges[beam], message.range_min, reach);
    const bool hit = isHit(range, message.range_min, reach);
    if (!hit && !isNoReturn(range, reach)) {
      ++converted.beams.dropped;
      continue;
    }
    ++(hit ? converted.beams.hits : converted.beams.no_return);
    if (!hit && free_range == 0.0) {
      continue;
    }
    const double bearing =
        normalizeAngle(scan.field.first_bearing + scan.field.beam_spacing * beam);
    scan.rays.push_back(rayAt(bearing, hit ? range : free_range, mount));
    scan.rays.back().hit = hit;
    scan.rays.back().beam = beam;
    scan.rays.back().time = time_increment * beam;
  }
  return converted;
}

}  // namespace

void ScanConversionOptions::visit(OptionVisitor& visitor) {
  visitor.number({"free_range", "m",
                  "a beam without return is assumed free up to this range (or the scanner's "
                  "range_max); less than the scanner's reach, since distant dark objects return "
                  "nothing; 0: such beams are blind",
                  Tier::kPublic},
                 free_range, {0.0, 500.0});
  visitor.number(
      {"max_sweep", "s",
       "maximum time from the first to the last beam; a scan with more has no usable beam times "
       "and is not motion-compensated (slow rotating scanners turn 5 times a second)"},
      max_sweep, {0.0, 2.0});
}

ConvertedScan toScan(const sensor_msgs::LaserScan& message, const ScannerMount& mount,
                     const ScanConversionOptions& options) {
  return convert(message, mount, options);
}

ConvertedScan toScan(const sensor_msgs::MultiEchoLaserScan& message, const ScannerMount& mount,
                     const ScanConversionOptions& options) {
  return convert(message, mount, options);
}

std::vector<InputError> faultsOf(const ScannerMount& mount, const ConvertedScan& converted,
                                 double max_tilt, const std::string& without_beams) {
  std::vector<InputError> faults;
  if (converted.unusable_times) {
    faults.push_back(*converted.unusable_times);
  }
  if (mount.tilt > max_tilt) {
    faults.emplace_back("tilted_scanner",
                        "scan plane tilted by " + std::to_string(toDegrees(mount.tilt)) +
                            " degrees: expected at most " + std::to_string(toDegrees(max_tilt)));
  }
  const BeamCounts& beams = converted.beams;
  if (beams.hits == 0 && beams.no_return == 0) {
    faults.emplace_back("no_valid_beam", "scan with " + std::to_string(beams.dropped) +
                                             " beams, none of them valid: " + without_beams);
  }
  return faults;
}

}  // namespace datmo
