// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "evaluate/matching.h"

namespace datmo::evaluation {

/// Root mean square errors of tracks that are matched to required truths; none: no sample.
struct StateErrors {
  std::optional<double> position;  ///< of the box's center, m
  std::optional<double> velocity;  ///< of the vector, m/s
  std::optional<double> heading;   ///< rad, 0 to pi
  /// rad, 0 to pi / 2: front and rear may be exchanged.
  std::optional<double> heading_modulo_pi;
  std::size_t samples = 0;
};

/// Collects matched pairs.
class StateErrorSum {
 public:
  void add(const TrueState& truth, const TrackState& track);
  StateErrors result() const;

 private:
  double position_ = 0.0;           // m^2
  double velocity_ = 0.0;           // m^2/s^2
  double heading_ = 0.0;            // rad^2
  double heading_modulo_pi_ = 0.0;  // rad^2
  std::size_t samples_ = 0;
};

/// Over all frames. `matching` is of these frames.
StateErrors scoreStateErrors(const Frames& frames, const Matching& matching);

/// The same of the objects within a range (m) of a position, which differs in each frame.
StateErrors scoreNearErrors(const Frames& frames, const Matching& matching,
                            const std::vector<Point2>& positions, double range);

}  // namespace datmo::evaluation
