#pragma once

#include <array>

#include "datmo_fusion/common/class_belief.h"
#include "datmo_fusion/common/object.h"
#include "datmo_fusion/common/options.h"

namespace datmo {

/// How large one kind of road user or pole is, over all of them: upright boxes.
struct KindSize {
  double share = 0.0;                       ///< of all objects, in any unit
  double height = 0.0, height_sigma = 0.0;  ///< m
  double length = 0.0, length_sigma = 0.0;  ///< m
  double width = 0.0, width_sigma = 0.0;    ///< m

  void visit(OptionVisitor& visitor);
};

struct ObjectClassifierOptions {
  KindSize pedestrian{4.0, 1.70, 0.12, 0.55, 0.15, 0.55, 0.15};
  KindSize cyclist{2.0, 1.75, 0.10, 1.80, 0.15, 0.60, 0.10};
  KindSize car{4.0, 1.50, 0.12, 4.4, 0.4, 1.8, 0.12};
  KindSize van{2.0, 2.2, 0.3, 5.2, 0.6, 2.0, 0.15};
  KindSize truck{1.0, 3.4, 0.4, 9.0, 2.5, 2.5, 0.15};
  KindSize pole{3.0, 4.5, 1.2, 0.2, 0.1, 0.2, 0.1};
  double else_share = 1.0;
  double least_probability = 0.4;

  void visit(OptionVisitor& visitor);
};

/// Upright sizes of an object as a sensor sees them.
struct SeenSize {
  double height = 0.0;        ///< m above the road
  double height_sigma = 0.0;  ///< m
  bool higher = false;        ///< its top was not seen: it may be higher
  double across = 0.0;        ///< m, across the line of sight
  double across_sigma = 0.0;  ///< m
  bool wider = false;         ///< an end was not seen: it may be wider
};

/// What an object is, by how large it looks from a direction that is not known: Bayes over kinds of
/// road users and poles of known sizes, and over anything else, of any size.
class ObjectClassifier {
 public:
  /// Throws OptionError.
  explicit ObjectClassifier(const ObjectClassifierOptions& options);

  /// Of kUnknown: that it is anything else.
  ClassProbabilities probabilities(const SeenSize& seen) const;

 private:
  ObjectClassifierOptions options_;
};

}  // namespace datmo
