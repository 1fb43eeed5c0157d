// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "datmo_fusion/common/class_belief.h"
#include "datmo_fusion/common/object.h"
#include "datmo_fusion/common/options.h"

namespace datmo {

/// Size distribution of one kind of object: upright boxes.
struct KindSize {
  double share = 0.0;                       ///< relative to the other kinds
  double height = 0.0, height_sigma = 0.0;  ///< m
  double length = 0.0, length_sigma = 0.0;  ///< m
  double width = 0.0, width_sigma = 0.0;    ///< m
  double relief_sigma = 0.0;                ///< m

  void visit(OptionVisitor& visitor);
};

struct ObjectClassifierOptions {
  KindSize pedestrian{4.0, 1.70, 0.15, 0.5, 0.15, 0.55, 0.15, 0.1};
  /// As long as it looks: wheels are low and thin.
  KindSize cyclist{4.0, 1.72, 0.13, 1.6, 0.3, 0.60, 0.15, 0.3};
  KindSize car{6.0, 1.45, 0.20, 4.2, 0.5, 1.75, 0.15, 0.7};
  KindSize van{2.0, 2.1, 0.3, 5.2, 0.6, 1.95, 0.15, 0.5};
  KindSize truck{1.0, 3.4, 0.4, 9.0, 2.5, 2.5, 0.15, 0.4};
  KindSize pole{3.0, 4.5, 1.2, 0.2, 0.1, 0.2, 0.1, 0.05};
  double other_share = 2.0;  ///< relative to the kinds' shares

  void visit(OptionVisitor& visitor);
};

/// How large an upright object is, as a sensor sees it.
struct SeenSize {
  double height = 0.0;        ///< m above the road
  double height_sigma = 0.0;  ///< m
  bool higher = false;        ///< its top was not seen: it may be higher
  double across = 0.0;        ///< m, across the line of sight
  double across_sigma = 0.0;  ///< m
  double along = 0.0;         ///< m, in depth, of the sides that are seen
  double along_sigma = 0.0;   ///< m
  bool wider = false;         ///< an end was not seen: both may be more
};

/// What an object is, by how large it looks from a direction that is not known: Bayes over kinds of
/// road users and poles of known sizes, and over anything else, of any size. The thesis takes the
/// class as its stereo system gives it, by size, shape and motion (3.3.2).
///
/// From ahead or behind, a cyclist looks like a pedestrian: then it says so by its probability.
class ObjectClassifier {
 public:
  /// Throws OptionError.
  explicit ObjectClassifier(const Checked<ObjectClassifierOptions>& options);

  /// Of kUnknown: that it is anything else.
  ClassProbabilities probabilities(const SeenSize& seen) const;

  /// Logarithm of the odds that it is of one of the kinds, over those before it was seen.
  double logOddsOfKnown(const ClassProbabilities& probabilities) const;

 private:
  ObjectClassifierOptions options_;
};

}  // namespace datmo
