// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/road/border_presence.h"

namespace datmo {

struct IntersectionDetectorOptions {
  double min_opening = 8.0;   ///< m
  double max_opening = 45.0;  ///< m
  double enter_above = 0.9;   ///< 1
  double leave_below = 0.3;   ///< 1

  void visit(OptionVisitor& visitor);
  void check() const;
};

/// Detects whether the vehicle is at an intersection: where, on one side or both, there is no
/// border for the width of a street at least, where there was one before.
///
/// The thesis (3.5.2) takes any scan without borders for one. Here the openings along the path of
/// the vehicle are evidence for a hidden Markov model with two states, on the road and at an
/// intersection, that advances with the distance driven and not with time: one that stands keeps
/// its state, and a few wrong stations make none. A border that was lost, one that never was, a gap
/// in a row of cars and a yard are no openings.
class IntersectionDetector {
 public:
  /// Throws OptionError.
  explicit IntersectionDetector(const Checked<IntersectionDetectorOptions>& options);

  /// Updates with where the borders are now; the distance driven rises, or all starts again. The
  /// stations reach some meters (`min_border`) behind the vehicle at least, and as far ahead as
  /// is known.
  void update(const BorderPresence& presence);

  /// 0 to 1, that the vehicle is at an intersection.
  double probability() const { return probability_; }

  /// The same as yes or no, with hysteresis.
  bool atIntersection() const { return at_intersection_; }

  /// Forgets all, as at the start.
  void reset();

 private:
  using BorderEnd = std::optional<double>;  ///< m, distance driven where the last border ended

  /// What is known of one side of the road that was driven.
  struct PassedSide {
    BorderEnd border_end;
    double bordered = 0.0;  ///< m of recent distance with a border
  };

  void pass(const SidePresence& side, double arc_length, double step, PassedSide& passed) const;

  /// Logarithm of the odds that the side is open beside the vehicle; 0 where nothing is known.
  double openness(const SidePresence& side, double arc_length, PassedSide& passed) const;
  bool isBorder(const SidePresence& side, int station, int toward) const;
  /// Of the stations between both arc lengths (m), none of them farther than a street's width.
  double meanOpenness(const SidePresence& side, double arc_length, double begin, double end) const;

  IntersectionDetectorOptions options_;
  std::optional<double> last_arc_length_;
  PassedSide left_;
  PassedSide right_;
  double probability_ = 0.0;
  bool at_intersection_ = false;
};

}  // namespace datmo
