// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/radar_objects_stage.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "datmo_fusion/ros/frames.h"

namespace datmo {

namespace {

/// Period before the stamp over which the vehicle's velocity is averaged, s: shorter ones are noisy
/// if it comes from poses.
constexpr double kTwistTime = 0.1;

/// Maximum elevation, rad: closer to vertical, range says nothing about the position on the ground.
constexpr double kMaxElevation = 1.0;

}  // namespace

void RadarObjectsStageOptions::visit(OptionVisitor& visitor) {
  visitor.number({"min_range", "m", "nearer returns are from the vehicle itself and are ignored"},
                 min_range, {0.2, 100.0});
  visitor.number({"max_range", "m", "maximum range of a return (data sheet)"}, max_range,
                 {1.0, 1000.0});
  visitor.number({"max_doppler", "m/s", "maximum speed of a return (data sheet)"}, max_doppler,
                 {1.0, 300.0});
  visitor.integer({"max_returns", "", "maximum per cycle; returns beyond it are ignored"},
                  max_returns, {1.0, 10000.0});
  visitor.group("input", [&] { input.visit(visitor); });
  visitor.group("detector", [&] { detector.visit(visitor); });
}

RadarObjectsStage::RadarObjectsStage(const Checked<RadarObjectsStageOptions>& options,
                                     const TransformBuffer& transforms, StageMonitor& monitor)
    : ObjectSource("radar", *options, transforms, monitor),
      options_(*options),
      detector_(options->detector) {}

RadarCycle RadarObjectsStage::cycleOf(const RadarScanMessage& message) {
  RadarCycle cycle;
  cycle.stamp = toStamp(message.header.stamp);
  const ScannerMount mount =
      scannerMount(transforms_.core(), options_.frames.base, message.header.frame_id);
  if (mount.upside_down) {
    throw InputError("bad_mount", "frame \"" + message.header.frame_id +
                                      "\" is upside down: expected a radar whose z axis is up");
  }
  cycle.radar_in_base = mount.scanner_in_base;
  std::uint64_t bad = 0;
  for (const datmo_fusion::RadarReturn& one : message.returns) {
    // Comparisons with NaN are false.
    const bool is_good = one.range > 0.0F && one.range <= options_.max_range &&
                         std::abs(one.azimuth) <= kPi && std::abs(one.elevation) <= kMaxElevation &&
                         std::abs(one.doppler_velocity) <= options_.max_doppler;
    const double level = std::cos(static_cast<double>(one.elevation));
    const bool is_taken = cycle.returns.size() < static_cast<std::size_t>(options_.max_returns);
    if (!is_good || !is_taken) {
      ++bad;
    } else if (one.range * level >= options_.min_range) {
      cycle.returns.push_back({one.range * level, one.azimuth, one.doppler_velocity / level});
    }
  }
  if (bad > 0) {
    bad_returns_ += bad;
    monitor_.warned(InputError("bad_returns", std::to_string(bad) +
                                                  " returns are not finite, out of range or beyond "
                                                  "max_returns: left out, the others are used"));
  }
  return cycle;
}

Twist2 RadarObjectsStage::twistAt(Stamp stamp) const {
  const std::optional<Pose2> motion = motion_.between(stamp + -kTwistTime, stamp);
  if (!motion) {
    throw InputError("no_motion",
                     "the vehicle's motion up to the radar's cycle is unknown: expected odometry "
                     "before it, or, without odometry, poses of grid_slam");
  }
  return twistOf(*motion, kTwistTime);
}

ObjectList RadarObjectsStage::detect(const RadarScanMessage& message) {
  const RadarCycle cycle = cycleOf(message);
  checkStamp(message);
  RadarObjects objects = detector_.detect(cycle, twistAt(cycle.stamp));
  monitor_.figure("objects", static_cast<double>(objects.list.objects.size()));
  monitor_.figure("clusters that stand", static_cast<double>(objects.standing));
  monitor_.figure("returns in no cluster", static_cast<double>(objects.unclustered));
  monitor_.figure("bad returns", static_cast<double>(bad_returns_));
  return std::move(objects.list);
}

}  // namespace datmo
