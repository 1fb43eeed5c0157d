// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "datmo_fusion/common/class_belief.h"
#include "datmo_fusion/common/object.h"
#include "datmo_fusion/common/options.h"

namespace datmo {

/// Size distribution of one kind of upright object.
struct KindSize {
  double share = 0.0;                       ///< relative to the other kinds
  double height = 0.0, height_sigma = 0.0;  ///< m
  double length = 0.0, length_sigma = 0.0;  ///< m
  double width = 0.0, width_sigma = 0.0;    ///< m
  /// m, 0 to 10: standard deviation of the depth of its surface about that of a box: from bumper to
  /// windshield, from wheel to rider
  double relief_sigma = 0.0;

  void visit(OptionVisitor& visitor);
};

struct ObjectClassifierOptions {
  KindSize pedestrian{4.0, 1.70, 0.15, 0.5, 0.15, 0.55, 0.15, 0.1};
  /// Lengths are as they appear: wheels are low and thin.
  KindSize cyclist{4.0, 1.72, 0.13, 1.6, 0.3, 0.60, 0.15, 0.3};
  KindSize car{6.0, 1.45, 0.20, 4.2, 0.5, 1.75, 0.15, 0.7};
  KindSize van{2.0, 2.1, 0.3, 5.2, 0.6, 1.95, 0.15, 0.5};
  KindSize truck{1.0, 3.4, 0.4, 9.0, 2.5, 2.5, 0.15, 0.4};
  KindSize pole{3.0, 4.5, 1.2, 0.2, 0.1, 0.2, 0.1, 0.05};
  /// 0.001 to 1000: prior share of other objects, relative to these kinds
  double other_share = 2.0;

  void visit(OptionVisitor& visitor);
};

/// The visible size of an upright object.
struct SeenSize {
  double height = 0.0;        ///< m above the road
  double height_sigma = 0.0;  ///< m
  bool higher = false;        ///< its top was not visible: it may be higher
  double across = 0.0;        ///< m, across the line of sight
  double across_sigma = 0.0;  ///< m
  double along = 0.0;         ///< m, in depth, of the visible sides
  double along_sigma = 0.0;   ///< m
  bool wider = false;         ///< an end was not visible: both may be larger
};

/// Classifies an object by its apparent size from an unknown direction: Bayes over kinds of road
/// users and poles of known sizes, and over anything else, of any size. The thesis uses the class
/// from its stereo system, by size, shape and motion (3.3.2).
///
/// From the front or rear, a cyclist looks like a pedestrian, which the probabilities reflect.
class ObjectClassifier {
 public:
  /// Throws OptionError.
  explicit ObjectClassifier(const Checked<ObjectClassifierOptions>& options);

  /// Returns the class probabilities; kUnknown is that of anything else.
  ClassProbabilities probabilities(const SeenSize& seen) const;

  /// Returns the log odds of one of the known kinds, relative to the prior ones.
  double logOddsOfKnown(const ClassProbabilities& probabilities) const;

  /// Sets the class probabilities of an object, and these log odds as those of its existence: at
  /// most 0, at least -`max_doubt`.
  void classify(const SeenSize& seen, double max_doubt, Object& object) const;

 private:
  ObjectClassifierOptions options_;
};

}  // namespace datmo
