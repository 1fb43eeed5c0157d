// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "datmo_fusion/common/perpendicular.h"
#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/common/stamp.h"

namespace datmo {

/// One beam of a scan, in the vehicle's frame (base_link) at the time of the beam.
struct Ray {
  Point2 origin = Point2::Zero();  ///< m, where the beam starts: the scanner
  Point2 end = Point2::Zero();  ///< m, the hit; without one, as far as the beam is known to be free
  double range = 0.0;           ///< m, from origin to end
  double bearing = 0.0;         ///< rad, of the beam about the scanner, from its x axis
  std::uint32_t beam = 0;       ///< index of the beam in the scan
  bool hit = false;             ///< false: nothing was detected up to `end`
  double time = 0.0;            ///< s after the scan's stamp, 0 or more
};

/// Maximum number of beams of a scan: beam indices have 16 bits in messages.
inline constexpr std::uint32_t kMaxBeams = 65536;

/// Directions and ranges of a scan's beams, including those without a return. Bearings in rad about
/// the scanner, from its x axis to the left.
struct ScanField {
  double first_bearing = 0.0;  ///< of beam 0
  double beam_spacing = 0.0;   ///< from one beam to the next; negative: clockwise
  std::uint32_t beams = 0;     ///< 0: the field is unknown
  double min_range = 0.0;      ///< m, closer objects give no valid measurement
  double free_range = 0.0;     ///< m, a beam without return is free up to here; 0: unknown
  double range = 0.0;          ///< m, nothing is detected farther away
  double beam_time = 0.0;      ///< s, from one beam to the next; 0: all at once
};

/// A planar scan, validated and transformed to the vehicle's frame. Beams without a valid
/// measurement (NaN, below the minimum range) have no ray.
struct Scan {
  Stamp stamp;
  Pose2 scanner_in_base;
  ScanField field;
  std::vector<Ray> rays;  ///< by ascending beam index
};

/// Returns the step from a beam's end to that of the next beam at the same range, m, for this beam
/// spacing (rad).
inline Point2 stepAcross(const Ray& ray, double beam_spacing) {
  const Point2 along = ray.end - ray.origin;
  return beam_spacing * perpendicular(along);
}

/// State of the end point of a beam in the map (thesis 3.1.2, 3.3.1).
enum class PointState : std::uint8_t {
  kStatic = 0,   ///< on a known obstacle
  kMoving = 1,   ///< where the map was seen free, so the object must have moved in
  kUnknown = 2,  ///< nothing is known there yet
};

/// One end point of a scan in the vehicle's frame, classified against the map.
struct ScanPoint {
  Point2 position = Point2::Zero();  ///< m, base frame
  double range = 0.0;                ///< m, from the scanner
  double bearing = 0.0;              ///< rad, about the scanner
  std::uint32_t beam = 0;
  PointState state = PointState::kUnknown;
};

/// A scan split into static and moving points, and the pose from which it was taken.
struct LabeledScan {
  Stamp stamp;
  PoseWithCovariance base_in_map;
  Pose2 scanner_in_base;
  ScanField field;
  /// Beams without a valid measurement, so that nothing is known along them; ascending.
  std::vector<std::uint32_t> blind_beams;
  std::vector<ScanPoint> points;  ///< by ascending beam index; beams without a hit are omitted
};

}  // namespace datmo
