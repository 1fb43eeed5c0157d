// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/detection/segment_end.h"

#include <algorithm>
#include <cmath>

#include "datmo_fusion/common/cross.h"
#include "datmo_fusion/common/uniform.h"

namespace datmo {

namespace {

/// Ranges that differ by more standard deviations than this belong to different surfaces.
constexpr double kSurelyApart = 3.0;

Point2 turned(const Point2& vector, double angle) {
  return Pose2(Point2::Zero(), angle).rotate(vector);
}

}  // namespace

std::optional<SurfaceEnd> SegmentEnds::beyond(const ScanPoint& last, const Point2& along,
                                              double heading_std) const {
  const Point2 ray = (last.position - scan_.scanner_in_base.position()).normalized();
  // Beam indices increase to the left if their spacing is positive.
  const bool to_left = cross(ray, along) > 0.0;
  const std::optional<std::uint32_t> next =
      nextBeam(last.beam, to_left == (scan_.field.beam_spacing > 0.0) ? 1 : -1);
  if (!next) {
    return std::nullopt;
  }
  const double steps = static_cast<double>(*next) - static_cast<double>(last.beam);
  const Point2 next_ray = turned(ray, scan_.field.beam_spacing * steps);
  double expected = 0.0;
  double widest = 0.0;
  for (const double turn : {-heading_std, heading_std, 0.0}) {
    // Solves last + gap * along = range * next_ray, relative to the scanner.
    const Point2 direction = turned(along, turn);
    const double determinant = cross(direction, next_ray);
    const double gap = -last.range * cross(ray, next_ray) / determinant;
    const double range = last.range * cross(direction, ray) / determinant;
    if (!(gap > 0.0 && gap <= max_gap_ && range > 0.0) || !seesFartherThan(*next, range)) {
      return std::nullopt;
    }
    expected = 0.5 * gap;
    widest = std::max(widest, gap);
  }
  const double slant = range_sigma_ * ray.dot(along);
  return SurfaceEnd{expected, kUniformVariance * widest * widest + slant * slant};
}

/// None at the edge of the field of view, and if the next beam's measurement is not valid.
std::optional<std::uint32_t> SegmentEnds::nextBeam(std::uint32_t beam, int step) const {
  if (beam >= scan_.field.beams || (step < 0 ? beam == 0 : beam + 1 == scan_.field.beams)) {
    return std::nullopt;
  }
  const std::uint32_t next = step < 0 ? beam - 1 : beam + 1;
  const bool blind = std::binary_search(scan_.blind_beams.begin(), scan_.blind_beams.end(), next);
  return blind ? std::nullopt : std::optional<std::uint32_t>(next);
}

bool SegmentEnds::seesFartherThan(std::uint32_t beam, double range) const {
  const auto point = std::lower_bound(
      scan_.points.begin(), scan_.points.end(), beam,
      [](const ScanPoint& candidate, std::uint32_t value) { return candidate.beam < value; });
  if (point == scan_.points.end() || point->beam != beam) {
    return scan_.field.free_range >= range;
  }
  return point->range > range + kSurelyApart * range_sigma_;
}

}  // namespace datmo
