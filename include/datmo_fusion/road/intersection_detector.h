// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "datmo_fusion/common/options.h"

namespace datmo {

struct IntersectionDetectorOptions {
  double evidence_length = 2.0;        ///< m
  double seen_at_intersection = 0.75;  ///< 1
  double seen_on_road = 0.05;          ///< 1
  double min_road = 15.0;              ///< m
  double enter_above = 0.9;            ///< 1
  double leave_below = 0.3;            ///< 1

  void visit(OptionVisitor& visitor);
  void check() const;
};

/// What is seen at one point of the vehicle's path.
struct IntersectionObservation {
  double arc_length = 0.0;  ///< m, distance driven
  bool bordered = false;    ///< a border of the road runs beside the vehicle
  int branches = 0;         ///< streets that lead away from there (BranchSearch)
};

/// Detects whether the vehicle is at an intersection: where three streets or more lead away, on a
/// road that had borders. The thesis (3.5.2) takes any scan without borders for one.
///
/// A hidden Markov model with two states, on the road and at an intersection, that advances with
/// the distance driven and not with time: one that stands keeps its state, and a single wrong
/// observation makes none.
class IntersectionDetector {
 public:
  /// Throws OptionError.
  explicit IntersectionDetector(const Checked<IntersectionDetectorOptions>& options);

  /// Whether so much has been driven that the next observation says something new.
  bool isDue(double arc_length) const;

  /// Takes in an observation; the distance driven rises, or all starts again.
  void update(const IntersectionObservation& observation);

  /// 0 to 1, that the vehicle is at an intersection.
  double probability() const { return probability_; }

  /// The same as yes or no, with hysteresis.
  bool atIntersection() const { return at_intersection_; }

  /// Forgets all, as at the start.
  void reset();

 private:
  IntersectionDetectorOptions options_;
  std::optional<double> last_arc_length_;
  double bordered_ = 0.0;  ///< m of recent distance with a border
  double probability_ = 0.0;
  bool at_intersection_ = false;
};

}  // namespace datmo
