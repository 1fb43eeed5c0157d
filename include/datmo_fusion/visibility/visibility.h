// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "datmo_fusion/common/box2.h"
#include "datmo_fusion/common/field_of_view.h"
#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/scan.h"
#include "datmo_fusion/common/view_fan.h"
#include "datmo_fusion/visibility/beam_fan.h"

namespace datmo {

struct VisibilityOptions {
  double beam_detection = 0.9;       ///< 1
  double max_probability = 0.95;     ///< 1
  double min_probability = 0.02;     ///< 1
  double unknown_probability = 0.5;  ///< 1
  double blocking_distance = 0.5;    ///< m

  void visit(OptionVisitor& visitor);
};

/// What a sensor could have seen at one time: the detection probability of an object, given field
/// of view, range and occlusion. In the vehicle's frame (base_link), or in that of the fans that it
/// is made from.
///
/// The view is a fan of beams, each as long as the sensor could see along it. A scanner is assumed
/// to detect an object if at least one beam hits it and returns; other sensors detect it in
/// proportion to its share that is not occluded.
class Visibility {
 public:
  /// Unknown view: every object is detected with `unknown_probability`.
  explicit Visibility(const Checked<VisibilityOptions>& options);

  /// View by the beams of this scan, whatever they hit; those without return reach the maximum
  /// range, blind ones nowhere. Unknown if the scan's field is unknown. The beams start at the
  /// scanner's pose at the scan's stamp.
  Visibility(const LabeledScan& scan, const VisibilityOptions& options);

  /// View by a field of view, with the boxes (base frame) of what was seen in it as occluders.
  Visibility(const FieldOfView& view, const std::vector<Box2>& seen,
             const VisibilityOptions& options);

  /// View by all of these valid (isValid) fans, one per sensor (see join()). Unknown if there are
  /// none; fans without beams carry no information.
  Visibility(const std::vector<ViewFan>& fans, const VisibilityOptions& options);

  /// Adds another sensor: from now on an object is detected if either sensor detects it,
  /// independently.
  void join(const Visibility& other) { others_.push_back(other); }

  /// Returns the detection probability of an object of this box, averaged over its possible
  /// positions: `sigma` is the standard deviation of its center along each axis (m, at least 0).
  /// The result is between `min_probability` and `max_probability`.
  double detectionProbability(const Box2& box, double sigma) const;

  /// Returns the fans of this sensor and of all that joined it, as far as their views are known.
  std::vector<ViewFan> fans() const;

 private:
  /// Offset of a possible position of a box from the assumed one, as seen from the sensor.
  struct Shift {
    double bearing = 0.0;  ///< rad
    double range = 0.0;    ///< m
  };
  class Outline;

  /// One line of sight to an object.
  struct Look {
    double bearing;  ///< rad, about the sensor
    double range;    ///< m, to the object's near side
  };
  static constexpr std::size_t kLooks = 8;
  using Looks = std::array<Look, kLooks>;

  /// For this sensor alone.
  double ownDetectionProbability(const Box2& box, double sigma) const;

  void setFan(ViewFan fan);

  /// Lines of sight, evenly spread over an object's width.
  static Looks looksAt(const Outline& outline);

  /// Share of them along which the sensor saw at least as far as the object.
  double clearShare(const Looks& looks, const Shift& shift) const;

  /// Factor on the detection probability at this range: 1 up to sure_range.
  double strengthAt(double range) const;

  /// Probability that at least one of this many beams returns, each with the probability `chance`.
  static double anyReturns(double beams, double chance);

  VisibilityOptions options_;
  ViewFan fan_;  ///< without beams: unknown
  BeamFan beams_;
  std::vector<Visibility> others_;
};

}  // namespace datmo
