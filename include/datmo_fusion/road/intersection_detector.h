// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "datmo_fusion/common/options.h"

namespace datmo {

struct IntersectionDetectorOptions {
  /// m, 0.1 to 50: distance between two positions at which the observed streets are independent of
  /// each other
  double evidence_length = 2.0;
  /// 0.01 to 0.99: probability that three streets are seen at an intersection, despite waiting and
  /// crossing traffic
  double seen_at_intersection = 0.75;
  double seen_on_road = 0.05;  ///< 1
  double min_road = 15.0;      ///< m
  /// 0.01 to 0.99: probability above which the vehicle is at an intersection
  double enter_above = 0.9;
  double leave_below = 0.3;  ///< 1

  void visit(OptionVisitor& visitor);
  void check() const;
};

/// Observation at one point of the vehicle's path.
struct IntersectionObservation {
  double arc_length = 0.0;  ///< m, distance driven
  bool bordered = false;    ///< a border of the road runs beside the vehicle
  int branches = 0;         ///< number of streets that lead away from there (BranchSearch)
};

/// Detects whether the vehicle is at an intersection: three or more streets lead away, on a road
/// that had borders. The thesis (3.5.2) considers any scan without borders an intersection.
///
/// A hidden Markov model with two states, on the road and at an intersection, that advances with
/// the distance driven rather than time: a stationary vehicle keeps its state, and a single wrong
/// observation does not change it.
class IntersectionDetector {
 public:
  /// Throws OptionError.
  explicit IntersectionDetector(const Checked<IntersectionDetectorOptions>& options);

  /// Whether the vehicle has driven far enough for the next observation to be informative.
  bool isDue(double arc_length) const;

  /// Processes an observation; resets if the distance driven decreases.
  void update(const IntersectionObservation& observation);

  /// 0 to 1, probability that the vehicle is at an intersection.
  double probability() const { return probability_; }

  /// The decision, with hysteresis.
  bool atIntersection() const { return at_intersection_; }

  /// Forgets everything, as after construction.
  void reset();

 private:
  IntersectionDetectorOptions options_;
  std::optional<double> last_arc_length_;
  double bordered_ = 0.0;  ///< m of recent distance with a border
  double probability_ = 0.0;
  bool at_intersection_ = false;
};

}  // namespace datmo
