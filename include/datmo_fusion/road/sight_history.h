#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/scan.h"

namespace datmo {

struct SightHistoryOptions {
  double memory = 4.0;               ///< s
  int most_scans = 200;              ///< 1
  double tolerance = 0.4;            ///< m
  double bearing_tolerance = 0.005;  ///< rad
  double lit_share = 0.5;            ///< 1
  double least_incidence = 0.1;      ///< rad

  void visit(OptionVisitor& visitor);
};

/// A point in the map, and the direction of the surface there: a curb reflects a beam where the
/// beam crosses it, which for a grazing beam may be some distance along from the point.
struct SightPlace {
  Point2 position = Point2::Zero();    ///< m, map frame
  Point2 direction = Point2::UnitX();  ///< of length 1
};

/// What one scan observed at a point.
enum class Sight {
  kNothing,  ///< not in view, or occluded
  kFree,     ///< a beam crossed the line of the surface
  kHit,      ///< a beam ended on it
};

/// The beams of the last scans in the map frame, to look up what each of them observed at a point.
class SightHistory {
 public:
  explicit SightHistory(const SightHistoryOptions& options);

  /// By rising stamps.
  void add(const SplitScan& scan);
  void clear() { scans_.clear(); }

  std::size_t size() const { return scans_.size(); }

  /// How long before the newest scan one was taken, s; 0: the newest. `back` below size().
  double age(std::size_t back) const;

  /// What that scan observed at a point, by the beam toward it.
  Sight look(std::size_t back, const SightPlace& place) const;

 private:
  /// A beam, from the scanner on.
  struct Beam {
    float reach = -1.0F;  ///< m, as far as it saw; negative: nothing is known of it
    bool hit = false;     ///< it ended there
  };
  struct Scan {
    Stamp stamp;
    Pose2 map_in_scanner;
    ScanField field;
    std::vector<Beam> beams;
  };

  const Beam* beamTowards(const Scan& scan, const Point2& seen, double& bearing) const;

  SightHistoryOptions options_;
  std::deque<Scan> scans_;  ///< newest first
};

}  // namespace datmo
