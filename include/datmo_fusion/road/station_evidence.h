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

/// How sure it is that a line is a border at each meter of it: logarithm of the odds, raised by
/// beams that end on it, lowered by those that go on through it. A scan counts once, and the sum is
/// held within bounds, as what a vehicle sees while it stands is always the same.
class StationEvidence {
 public:
  explicit StationEvidence(const StationEvidenceOptions& options);

  /// Nothing is known of what lies outside of `interval` any more, and evidence may be added of
  /// what lies inside.
  void keepWithin(const ArcLengthInterval& interval);

  /// One beam of the scan that ended on the line there (m along it), or went through.
  void addHit(double along);
  void addPassage(double along);

  /// How far a beam that went through there saw what is behind: so deep as only a street is, or
  /// not.
  void addDepth(double along, bool deep);

  /// Applies the evidence of one scan's beams since the last call.
  void endScan();

  /// 0 where nothing is known.
  double logOdds(double along) const;

  /// The same that the road is open there: that beams see deep through the line; 0 where nothing is
  /// known.
  double openLogOdds(double along) const;

  /// The most that they become.
  double saturation() const { return options_.saturation; }

  /// Where the line is a border: from the first to the last station seen of each piece; gaps of
  /// `bridged_gap` between two stations are left out, shorter ones belong to the piece.
  std::vector<ArcLengthInterval> pieces() const;

  /// Stations by themselves that are seen.
  int seenStations() const;

 private:
  struct Station {
    double log_odds = 0.0;
    double update = 0.0;  ///< by this scan
    double open_log_odds = 0.0;
    double open_update = 0.0;
  };

  /// The number of stations where there is none.
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
