// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/scan_labeling.h"

#include <cstdint>

namespace datmo {

namespace {

/// Beams of the scan that have no ray.
std::vector<std::uint32_t> blindBeams(const Scan& scan) {
  std::vector<std::uint32_t> blind;
  std::uint32_t beam = 0;
  for (const Ray& ray : scan.rays) {
    for (; beam < ray.beam; ++beam) {
      blind.push_back(beam);
    }
    beam = ray.beam + 1;
  }
  for (; beam < scan.field.beams; ++beam) {
    blind.push_back(beam);
  }
  return blind;
}

}  // namespace

std::vector<PointState> judgeRays(const Scan& scan, const OccupancyMap& map,
                                  const Pose2& base_in_map) {
  std::vector<PointState> states;
  states.reserve(scan.rays.size());
  for (const Ray& ray : scan.rays) {
    const Point2 half_footprint = 0.5 * stepAcross(ray, scan.field.beam_spacing);
    states.push_back(ray.hit ? map.judge(base_in_map * ray.end, base_in_map.rotate(half_footprint))
                             : PointState::kUnknown);
  }
  return states;
}

MapAgreement agreementOf(const Scan& scan, const std::vector<PointState>& states,
                         const OccupancyMap& map, const Pose2& base_in_map) {
  MapAgreement agreement{static_cast<int>(scan.rays.size()), 0, 0};
  for (std::size_t i = 0; i < scan.rays.size(); ++i) {
    const bool is_contradicted =
        states[i] == PointState::kMoving ||
        (states[i] == PointState::kUnknown && map.seesThrough(scan.rays[i], base_in_map));
    agreement.contradicted += is_contradicted ? 1 : 0;
    agreement.confirmed += states[i] == PointState::kStatic ? 1 : 0;
  }
  return agreement;
}

LabeledScan labelScan(const Scan& scan, const std::vector<PointState>& states,
                      const PoseWithCovariance& base_in_map) {
  LabeledScan result{scan.stamp, base_in_map,      scan.scanner_in_base,
                     scan.field, blindBeams(scan), {}};
  result.points.reserve(scan.rays.size());
  for (std::size_t i = 0; i < scan.rays.size(); ++i) {
    const Ray& ray = scan.rays[i];
    if (ray.hit) {
      result.points.push_back({ray.end, ray.range, ray.bearing, ray.beam, states[i]});
    }
  }
  return result;
}

}  // namespace datmo
