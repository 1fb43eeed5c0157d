// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <vector>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/scan.h"

namespace datmo {

struct ScanHistoryOptions {
  double memory = 4.0;         ///< s
  int max_scans = 200;         ///< 1
  double tolerance = 0.4;      ///< m
  double lit_share = 0.5;      ///< 1
  double min_incidence = 0.1;  ///< rad

  void visit(OptionVisitor& visitor);
};

/// A point in the map, and the direction of the surface there: a beam hits a curb where it crosses
/// it, which for a grazing beam may be some distance from the point along the curb.
struct ReflectionPoint {
  Point2 position = Point2::Zero();    ///< m, map frame
  Point2 direction = Point2::UnitX();  ///< unit length; zero: unknown, the surface faces the beam
};

/// What one scan observed at a point.
enum class BeamOutcome {
  kNothing,  ///< not in view, or occluded
  kFree,     ///< a beam crossed the surface's line
  kHit,      ///< a beam ended on it
};

/// A beam at the line of a surface. The outcome is kHit if it ended within +-`tolerance` of the
/// intersection, kFree if it went farther.
struct BeamCrossing {
  BeamOutcome outcome = BeamOutcome::kNothing;
  Point2 position = Point2::Zero();    ///< m, map frame: the intersection
  Point2 along_beam = Point2::Zero();  ///< unit length, map frame
  double tolerance = 0.0;              ///< m, along the beam: larger at grazing incidence
};

/// The beams of recent scans in the map frame, to look up what each observed at a point.
class ScanHistory {
 public:
  explicit ScanHistory(const Checked<ScanHistoryOptions>& options);

  /// Adds a scan, in ascending stamp order.
  void add(const LabeledScan& scan);
  void clear() { scans_.clear(); }

  std::size_t size() const { return scans_.size(); }

  /// Returns the age of a scan relative to the newest, s. `back`: 0 is the newest; below size().
  double age(std::size_t back) const;
  Stamp stamp(std::size_t back) const { return scans_[back].stamp; }

  /// Returns the scanner's position at that scan, m, map frame.
  const Point2& scanner(std::size_t back) const { return scans_[back].scanner; }

  /// Returns the distance along a beam, m, within which an end lies on a surface.
  double tolerance() const { return options_.tolerance; }

  /// Returns the beam of that scan toward a point (m, map frame); none if it is not in view.
  std::optional<std::size_t> beamIndex(std::size_t back, const Point2& position) const;

  /// Returns whether a beam of that scan ended within tolerance() of a point (m, map frame).
  bool endsAt(std::size_t back, const Point2& position) const;

  /// Returns what that scan observed at a point, by the beam toward it.
  BeamCrossing look(std::size_t back, const ReflectionPoint& location) const;

 private:
  /// A beam from the scanner.
  struct Beam {
    float reach = -1.0F;  ///< m, known range; negative: unknown
    bool hit = false;     ///< it ended there
  };
  struct Scan {
    Stamp stamp;
    Point2 scanner;  ///< m, map frame
    Pose2 map_in_scanner;
    ScanField field;
    std::vector<Beam> beams;
    std::vector<Point2> ends;  ///< m, map frame, by the vehicle's pose at the stamp
  };

  const Beam* beamToward(const Scan& scan, const Point2& seen, double& bearing) const;

  ScanHistoryOptions options_;
  std::deque<Scan> scans_;  ///< newest first
};

}  // namespace datmo
