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

/// What a sensor could have seen at one time: how likely an object would have been detected, by
/// field of view, range and occlusion by what is nearer. In the vehicle's frame (base_link), or in
/// that of the fans that it is made of.
///
/// The view is a fan of beams, each of which reaches as far as the sensor saw along it. In a scan
/// an object is taken to be detected by one beam that meets it and returns, in a field of view by
/// the share of it that is not hidden.
class Visibility {
 public:
  /// Nothing is known of the view: every object is seen with `unknown_probability`.
  explicit Visibility(const Checked<VisibilityOptions>& options);

  /// By the beams of this scan, whatever they hit; those without return reach as far as the scanner
  /// sees, blind ones nowhere. A scan whose field is not known gives an unknown view. The beams
  /// start at the scanner's pose at the scan's stamp.
  Visibility(const LabeledScan& scan, const VisibilityOptions& options);

  /// By a field of view and the boxes (base frame) of what was seen in it, behind which nothing is.
  Visibility(const FieldOfView& view, const std::vector<Box2>& seen,
             const VisibilityOptions& options);

  /// By all of these fans, each a sensor's (see join()), which are valid (isValid); of none nothing
  /// is known, and one without beams carries no information.
  Visibility(const std::vector<ViewFan>& fans, const VisibilityOptions& options);

  /// Another sensor looked as well: from now on an object is detected if either sees it,
  /// independently.
  void join(const Visibility& other) { others_.push_back(other); }

  /// That an object of this box is detected, averaged over the positions where it may be: `sigma`
  /// is the standard deviation of its center along each axis (m, at least 0). Between
  /// `min_probability` and `max_probability`.
  double detectionProbability(const Box2& box, double sigma) const;

  /// Of this sensor and of all that joined it, as far as their views are known.
  std::vector<ViewFan> fans() const;

 private:
  /// Where a box may be, seen from the sensor, beside where it is assumed to be.
  struct Shift {
    double bearing = 0.0;  ///< rad
    double range = 0.0;    ///< m
  };
  class Outline;

  /// One of the directions in which an object is looked at.
  struct Look {
    double bearing;  ///< rad, about the sensor
    double range;    ///< m, to the object's near side
  };
  static constexpr std::size_t kLooks = 8;
  using Looks = std::array<Look, kLooks>;

  /// By this sensor alone.
  double ownDetectionProbability(const Box2& box, double sigma) const;

  void setFan(ViewFan fan);

  /// Evenly spread over an object's width.
  static Looks looksAt(const Outline& outline);

  /// Share of them in which the sensor saw as far as the object.
  double clearShare(const Looks& looks, const Shift& shift) const;

  /// What is left at this range of the chance to see an object: 1 in the free range.
  double strengthAt(double range) const;

  /// That at least one of this many beams returns, each by this chance.
  static double anyReturns(double beams, double chance);

  VisibilityOptions options_;
  ViewFan fan_;  ///< without beams: unknown
  BeamFan beams_;
  std::vector<Visibility> others_;
};

}  // namespace datmo
