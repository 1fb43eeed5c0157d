// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "datmo_fusion/common/options.h"

namespace datmo {

struct StationEvidenceOptions {
  double hit_probability = 0.1;  ///< 1
  double clutter = 0.015;        ///< 1
  double max_per_scan = 1.5;     ///< 1
  double saturation = 4.0;       ///< 1
  double seen = 1.5;             ///< 1
  double bridged_gap = 8.0;      ///< m

  void visit(OptionVisitor& visitor);
};

/// An interval of arc length, m.
struct ArcLengthInterval {
  double first = 0.0;
  double last = 0.0;
};

/// Log odds that a line is a border at each meter of it: raised by beams that end on it, lowered by
/// those that pass through. Each scan counts once, and the sum is bounded, since a stationary
/// vehicle always observes the same.
class StationEvidence {
 public:
  explicit StationEvidence(const StationEvidenceOptions& options);

  /// Drops the stations outside `interval`; afterwards evidence may be added inside it.
  void keepWithin(const ArcLengthInterval& interval);

  /// Adds a beam of the scan that ended on the line at `along` (m), or passed through.
  void addHit(double along);
  void addPassage(double along);

  /// Adds whether a beam that passed through there saw as deep behind the line as only a street
  /// allows.
  void addDepth(double along, bool deep);

  /// Applies the evidence of one scan's beams since the last call.
  void endScan();

  /// 0 where unknown.
  double logOdds(double along) const;

  /// Log odds that the road is open there, because beams see deep through the line; 0 where
  /// unknown.
  double openLogOdds(double along) const;

  /// Upper bound of the log odds.
  double saturation() const { return options_.saturation; }

  /// Sections where the line is a border, each from its first to its last observed station; gaps
  /// of `bridged_gap` or more between stations separate sections, shorter ones are included.
  std::vector<ArcLengthInterval> pieces() const;

  /// Number of observed stations.
  int seenStations() const;

 private:
  struct Station {
    double log_odds = 0.0;
    double update = 0.0;  ///< from this scan
    double open_log_odds = 0.0;
    double open_update = 0.0;
  };

  /// Index of the station at `along`, or the number of stations if there is none.
  std::size_t slotAt(double along) const;
  Station* stationAt(double along);
  const Station* stationAt(double along) const;

  StationEvidenceOptions options_;
  double hit_;
  double passage_;
  double depth_;
  int first_ = 0;  ///< index of the first station
  std::deque<Station> stations_;
};

}  // namespace datmo
