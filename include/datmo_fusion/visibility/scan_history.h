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

/// A point in the map, and the direction of the surface there: a curb reflects a beam where the
/// beam crosses it, which for a grazing beam may be some distance along from the point.
struct ReflectionPoint {
  Point2 position = Point2::Zero();    ///< m, map frame
  Point2 direction = Point2::UnitX();  ///< of length 1; zero: not known, it faces the beam
};

/// What one scan observed at a point.
enum class BeamOutcome {
  kNothing,  ///< not in view, or occluded
  kFree,     ///< a beam crossed the line of the surface
  kHit,      ///< a beam ended on it
};

/// A beam at the line of a surface. The outcome is kHit if it ended within +-`tolerance` of where
/// it meets the line, kFree if it went farther.
struct BeamCrossing {
  BeamOutcome outcome = BeamOutcome::kNothing;
  Point2 position = Point2::Zero();    ///< m, map frame: where it meets the line
  Point2 along_beam = Point2::Zero();  ///< of length 1, map frame
  double tolerance = 0.0;  ///< m, along the beam: larger where they meet at a flat angle
};

/// The beams of the last scans in the map frame, to look up what each of them observed at a point.
class ScanHistory {
 public:
  explicit ScanHistory(const Checked<ScanHistoryOptions>& options);

  /// By rising stamps.
  void add(const LabeledScan& scan);
  void clear() { scans_.clear(); }

  std::size_t size() const { return scans_.size(); }

  /// How long before the newest scan one was taken, s; 0: the newest. `back` below size().
  double age(std::size_t back) const;
  Stamp stamp(std::size_t back) const { return scans_[back].stamp; }

  /// Where it was taken from, m, map frame.
  const Point2& scanner(std::size_t back) const { return scans_[back].scanner; }

  /// m, along a beam: an end nearer to a surface than this is on it.
  double tolerance() const { return options_.tolerance; }

  /// Index of the beam of that scan toward a point (m, map frame); none: not in view.
  std::optional<std::size_t> beamIndex(std::size_t back, const Point2& position) const;

  /// Whether a beam of that scan ended there (m, map frame).
  bool endsAt(std::size_t back, const Point2& position) const;

  /// What that scan observed at a point, by the beam toward it.
  BeamCrossing look(std::size_t back, const ReflectionPoint& location) const;

 private:
  /// A beam, from the scanner on.
  struct Beam {
    float reach = -1.0F;  ///< m, as far as it saw; negative: nothing is known of it
    bool hit = false;     ///< it ended there
  };
  struct Scan {
    Stamp stamp;
    Point2 scanner;  ///< m, map frame
    Pose2 map_in_scanner;
    ScanField field;
    std::vector<Beam> beams;
    std::vector<Point2> ends;  ///< m, map frame, where they were at the scan's stamp
  };

  const Beam* beamToward(const Scan& scan, const Point2& seen, double& bearing) const;

  ScanHistoryOptions options_;
  std::deque<Scan> scans_;  ///< newest first
};

}  // namespace datmo
