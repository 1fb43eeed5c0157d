// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>

#include "datmo_fusion/common/angle.h"

namespace datmo {

/// Finds the beam of a sensor that covers a direction; beams have equal spacing, from the first on.
///
/// A beam covers half a spacing to either side. Bearings may be off by any number of turns. If the
/// beams span more than a turn, the first of those that cover a direction is taken.
class BeamFan {
 public:
  BeamFan() = default;

  /// `first_bearing`: rad, of beam 0; `beam_spacing`: rad, not 0; negative: clockwise.
  BeamFan(double first_bearing, double beam_spacing)
      : first_bearing_(first_bearing),
        beam_spacing_(beam_spacing),
        per_radian_(1.0 / beam_spacing),
        per_turn_(2.0 * kPi / std::abs(beam_spacing)) {}

  /// Returns the bearing at a fractional beam index, rad; also beyond the last beam.
  double bearingAt(double position) const { return first_bearing_ + position * beam_spacing_; }

  /// Returns the fractional beam index of a bearing (rad): from half a beam before the first one to
  /// less than a turn later. NaN for NaN.
  double positionAt(double bearing) const { return wrapped(shifted(bearing)) - 0.5; }

  /// Returns the index of the beam, out of `beams`, that covers this bearing (rad); none if no beam
  /// does, or for NaN.
  std::optional<std::size_t> indexAt(double bearing, std::size_t beams) const {
    return among(wrapped(shifted(bearing)), beams);
  }

  /// Returns the beam nearest to a fractional index; none if no beam covers it, or for NaN.
  std::optional<std::size_t> nearest(double position, std::size_t beams) const {
    return among(wrapped(position + 0.5), beams);
  }

  /// Returns the number of beams within an angle of this width, rad.
  double beamsIn(double width) const { return width * std::abs(per_radian_); }

 private:
  /// The fractional index plus one half: its integer part is the index of the covering beam.
  double shifted(double bearing) const { return (bearing - first_bearing_) * per_radian_ + 0.5; }

  double wrapped(double shifted) const {
    return shifted < 0.0 || shifted >= per_turn_
               ? shifted - per_turn_ * std::floor(shifted / per_turn_)
               : shifted;
  }

  static std::optional<std::size_t> among(double shifted, std::size_t beams) {
    // Checked before the cast, which is undefined for values that are not an index.
    const bool inside = shifted >= 0.0 && shifted < static_cast<double>(beams);
    return inside ? std::optional<std::size_t>(static_cast<std::size_t>(shifted)) : std::nullopt;
  }

  double first_bearing_ = 0.0;  ///< rad
  double beam_spacing_ = 1.0;   ///< rad
  double per_radian_ = 1.0;     ///< more than 0: counterclockwise
  double per_turn_ = 2.0 * kPi;
};

}  // namespace datmo
