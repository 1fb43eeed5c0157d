#pragma once

#include <vector>

#include "datmo_fusion/common/box2.h"
#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/scan.h"

namespace datmo {

struct VisibilityOptions {
  double beam_detection = 0.9;        ///< 1, chance that one beam that meets an object returns
  double most_probability = 0.95;     ///< 1
  double least_probability = 0.02;    ///< 1
  double unknown_probability = 0.5;   ///< 1, without a view

  void visit(OptionVisitor& visitor);
};

/// What the sensors could have seen at one time: how likely an object would have been detected,
/// by field of view, range and occlusion by what is nearer. Vehicle's frame (base_link).
class Visibility {
 public:
  /// Nothing is known of the view: every object is seen with `unknown_probability`.
  explicit Visibility(const VisibilityOptions& options);

  /// By the beams of this scan.
  Visibility(const SplitScan& scan, const VisibilityOptions& options);

  /// That an object of this box, anywhere inside the standard deviation `sigma` (m, at least 0)
  /// about it, is detected.
  double detectionProbability(const Box2& box_in_base, double sigma) const;
};

}  // namespace datmo
