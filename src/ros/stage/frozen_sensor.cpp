// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/frozen_sensor.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "datmo_fusion/common/angle.h"

namespace datmo {

namespace {

/// m, rad; a measurement that stays identical over this motion is not current.
constexpr double kFrozenDistance = 0.3;
constexpr double kFrozenTurn = degrees(3.0);

/// With fewer echoes, rounded as a scanner does, all may be identical by chance.
constexpr std::ptrdiff_t kMinReturns = 10;

/// Some scanners report a missing return as a range beyond their maximum.
std::vector<std::uint8_t> bytesOf(const std::vector<float>& ranges, float min_range,
                                  float max_range) {
  const auto returns = std::count_if(ranges.begin(), ranges.end(), [&](float range) {
    return range > 0.0F && range >= min_range && range <= max_range;
  });
  if (returns < kMinReturns) {
    return {};
  }
  std::vector<std::uint8_t> bytes(ranges.size() * sizeof(float));
  std::memcpy(bytes.data(), ranges.data(), bytes.size());
  return bytes;
}

}  // namespace

bool FrozenSensor::update(Stamp stamp, std::vector<std::uint8_t> measured,
                          const MotionBetween& motion) {
  const Stamp before = std::exchange(last_stamp_, stamp);
  if (measured.empty() || measured != last_) {
    last_ = std::move(measured);
    moved_ = Pose2();
    is_frozen_ = false;
    return false;
  }
  // Step by step, because odometry is not stored for as long as a sensor may be frozen.
  if (const std::optional<Pose2> step = motion(before, stamp)) {
    moved_ = moved_ * *step;
  }
  is_frozen_ = is_frozen_ || moved_.position().norm() > kFrozenDistance ||
               std::abs(moved_.heading()) > kFrozenTurn;
  return is_frozen_;
}

void checkNotFrozen(bool is_frozen, StageMonitor& monitor) {
  static constexpr char kFrozen[] =
      "the scanner repeats its last scan bit for bit though the vehicle moves: its driver or the "
      "device hangs; its scans are dropped until they change";
  if (is_frozen) {
    monitor.condition(HealthLevel::kNoOutput, kFrozen);
    throw InputError("frozen_scan", kFrozen);
  }
  if (monitor.healthReason() == kFrozen) {
    monitor.condition(HealthLevel::kOk, "the scans change again");
  }
}

std::vector<std::uint8_t> measuredBytes(const sensor_msgs::LaserScan& scan) {
  return bytesOf(scan.ranges, scan.range_min, scan.range_max);
}

std::vector<std::uint8_t> measuredBytes(const sensor_msgs::MultiEchoLaserScan& scan) {
  std::vector<float> ranges;
  for (const sensor_msgs::LaserEcho& beam : scan.ranges) {
    ranges.insert(ranges.end(), beam.echoes.begin(), beam.echoes.end());
  }
  return bytesOf(ranges, scan.range_min, scan.range_max);
}

}  // namespace datmo
