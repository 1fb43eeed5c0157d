// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>

#include "datmo_fusion/common/angle.h"

namespace datmo {

/// Which beam of a sensor looks in a direction: beams at equal bearings, from the first one on.
///
/// A beam covers half a spacing to either side. Bearings are of any turn. Where the beams go round
/// by more than a turn, the first of those that look in a direction is taken.
class BeamFan {
 public:
  BeamFan() = default;

  /// `first_bearing`: rad, of beam 0; `beam_spacing`: rad, not 0; negative: to the right.
  BeamFan(double first_bearing, double beam_spacing)
      : first_bearing_(first_bearing),
        beam_spacing_(beam_spacing),
        per_radian_(1.0 / beam_spacing),
        per_turn_(2.0 * kPi / std::abs(beam_spacing)) {}

  /// rad; also between beams, and beyond the last one.
  double bearingAt(double position) const { return first_bearing_ + position * beam_spacing_; }

  /// Where a bearing (rad) lies among the beams, as a beam's index with its fraction: from half a
  /// beam before the first one to less than a turn later. NaN of NaN.
  double positionAt(double bearing) const { return wrapped(shifted(bearing)) - 0.5; }

  /// The beam of `beams` that covers this bearing (rad); none if no one does, or of NaN.
  std::optional<std::size_t> indexAt(double bearing, std::size_t beams) const {
    return among(wrapped(shifted(bearing)), beams);
  }

  /// The beam of `beams` that is nearest to this position; none if no one covers it, or of NaN.
  std::optional<std::size_t> nearest(double position, std::size_t beams) const {
    return among(wrapped(position + 0.5), beams);
  }

  /// Of so wide an angle, rad.
  double beamsIn(double width) const { return width * std::abs(per_radian_); }

 private:
  /// The position, half a beam on: its whole part is the index of the beam that covers it.
  double shifted(double bearing) const { return (bearing - first_bearing_) * per_radian_ + 0.5; }

  double wrapped(double shifted) const {
    return shifted < 0.0 || shifted >= per_turn_
               ? shifted - per_turn_ * std::floor(shifted / per_turn_)
               : shifted;
  }

  static std::optional<std::size_t> among(double shifted, std::size_t beams) {
    // Before the cast, which is undefined for what is no index.
    const bool inside = shifted >= 0.0 && shifted < static_cast<double>(beams);
    return inside ? std::optional<std::size_t>(static_cast<std::size_t>(shifted)) : std::nullopt;
  }

  double first_bearing_ = 0.0;  ///< rad
  double beam_spacing_ = 1.0;   ///< rad
  double per_radian_ = 1.0;     ///< more than 0: from right to left
  double per_turn_ = 2.0 * kPi;
};

}  // namespace datmo
