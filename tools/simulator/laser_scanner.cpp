// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/laser_scanner.h"

#include <algorithm>
#include <cmath>

namespace datmo::simulator {

namespace {

void check(const LaserScannerOptions& options) {
  checkOptions(options);
  if (options.min_range >= options.effective_range) {
    throw OptionError("min_range = " + std::to_string(options.min_range) +
                      ": expected less than effective_range, " +
                      std::to_string(options.effective_range) + " m");
  }
  if (options.sweep_duration * options.scan_rate > 1.0) {
    throw OptionError("sweep_duration = " + std::to_string(options.sweep_duration) +
                      ": expected at most the " + std::to_string(1.0 / options.scan_rate) +
                      " s from scan to scan");
  }
}

/// Position, from -1/2 to 1/2, of the center of part `index` of `count` equal parts.
double middleOfPart(int index, int count) { return (index + 0.5) / count - 0.5; }

bool nearer(const Echo& a, const Echo& b) { return a.range < b.range; }

double meanRange(std::vector<Echo>::const_iterator first, std::vector<Echo>::const_iterator last) {
  double sum = 0.0;
  for (auto hit = first; hit != last; ++hit) {
    sum += hit->range;
  }
  return sum / static_cast<double>(last - first);
}

}  // namespace

LaserScanner::LaserScanner(const LaserScannerOptions& options, const RandomStream& random)
    : options_(options), random_(random) {
  check(options_);
}

Viewpoint LaserScanner::viewpoint() const {
  return {"scanner", Pose2(options_.mount_x, options_.mount_y, degrees(options_.mount_heading)),
          options_.mount_height, degrees(options_.field_of_view),
          std::min(options_.effective_range, options_.max_range)};
}

EchoScan LaserScanner::measure(const World& world, double time) {
  const Viewpoint view = viewpoint();
  const int beams = options_.beamCount();
  const double azimuth_shake = random_.normal(degrees(options_.azimuth_shake));
  const double pitch_shake = random_.normal(degrees(options_.pitch_shake));
  EchoScan scan;
  scan.time = time;
  WorldState state = world.at(time);
  Pose2 scanner = state.base * view.sensor_in_base;
  RayCaster caster(world, state, scanner.position(), view.range);
  for (int beam = 0; beam < beams; ++beam) {
    if (options_.sweep_duration > 0.0 && beam > 0) {
      state = world.at(time + options_.sweep_duration * beam / (beams - 1));
      scanner = state.base * view.sensor_in_base;
      caster = RayCaster(world, state, scanner.position(), view.range);
    }
    BeamFaults faults;
    faults.azimuth = azimuth_shake + random_.normal(degrees(options_.azimuth_noise));
    faults.pitch = pitch_shake;
    faults.curbs = random_.chance(options_.curb_hit_probability);
    faults.paint = random_.chance(options_.paint_hit_probability);
    const double bearing = degrees(beam * options_.beam_spacing - 0.5 * options_.field_of_view);
    scan.beams.push_back(measureBeam(caster, scanner, bearing, faults));
  }
  return scan;
}

std::vector<Echo> LaserScanner::measureBeam(const RayCaster& caster, const Pose2& scanner,
                                            double bearing, const BeamFaults& faults) {
  const double heading = scanner.heading() + bearing + faults.azimuth;
  std::vector<Echo> targets;
  addTargets(caster, heading, 0.0, faults, targets);
  addTargets(caster, heading, degrees(options_.second_plane_pitch), faults, targets);
  return reported(std::move(targets));
}

void LaserScanner::addTargets(const RayCaster& caster, double heading, double plane_pitch,
                              const BeamFaults& faults, std::vector<Echo>& targets) {
  const std::vector<Echo> hits = castBeam(caster, heading, plane_pitch, faults);
  for (auto first = hits.cbegin(); first != hits.cend();) {
    auto last = std::next(first);
    while (last != hits.cend() &&
           last->range - std::prev(last)->range < options_.target_separation) {
      ++last;
    }
    const double share = static_cast<double>(last - first) / options_.sub_rays;
    if (random_.chance(share / options_.full_detection_share)) {
      const double range = meanRange(first, last);
      targets.push_back({range, first->object, first->surface});
    }
    first = last;
  }
}

std::vector<Echo> LaserScanner::castBeam(const RayCaster& caster, double heading,
                                         double plane_pitch, const BeamFaults& faults) const {
  const double pitch = plane_pitch + faults.pitch;
  const double half_opening = 0.5 * degrees(options_.vertical_opening);
  const HeightBand band{options_.mount_height, std::tan(pitch - half_opening),
                        std::tan(pitch + half_opening)};
  std::vector<Echo> hits;
  for (int i = 0; i < options_.sub_rays; ++i) {
    const double offset = degrees(options_.horizontal_opening) * middleOfPart(i, options_.sub_rays);
    if (const std::optional<RayHit> hit = castSubRay(caster, heading + offset, band, faults)) {
      hits.push_back({hit->range, hit->object, hit->surface});
    }
  }
  std::sort(hits.begin(), hits.end(), nearer);
  return hits;
}

std::optional<RayHit> LaserScanner::castSubRay(const RayCaster& caster, double heading,
                                               const HeightBand& band,
                                               const BeamFaults& faults) const {
  double reach = std::min(options_.effective_range, options_.max_range);
  std::optional<RayHit> nearest = caster.nearest(heading, band, Surface::kBody, reach);
  const auto add = [&](Surface surface, double farthest) {
    reach = std::min(nearest ? nearest->range : reach, farthest);
    if (const auto hit = caster.nearest(heading, band, surface, reach)) {
      nearest = hit;
    }
  };
  if (faults.curbs) {
    add(Surface::kCurb, reach);
  }
  if (faults.paint) {
    add(Surface::kPaint, options_.paint_range);
  }
  return nearest;
}

std::vector<Echo> LaserScanner::reported(std::vector<Echo> targets) {
  std::sort(targets.begin(), targets.end(), nearer);
  std::vector<Echo> echoes;
  for (const Echo& target : targets) {
    const bool different =
        echoes.empty() || target.range - echoes.back().range >= options_.target_separation;
    if (different && static_cast<int>(echoes.size()) < options_.echoes) {
      echoes.push_back(target);
    }
  }
  const double max = std::min(options_.effective_range, options_.max_range);
  for (Echo& echo : echoes) {
    echo.true_range = echo.range;
    echo.range += random_.normal(options_.range_noise);
  }
  echoes.erase(std::remove_if(echoes.begin(), echoes.end(),
                              [&](const Echo& echo) {
                                return echo.range < options_.min_range || echo.range > max;
                              }),
               echoes.end());
  std::sort(echoes.begin(), echoes.end(), nearer);
  return echoes;
}

}  // namespace datmo::simulator
