// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "datmo_fusion/common/class_belief.h"
#include "datmo_fusion/common/options.h"

namespace datmo {

/// How far a detector is to be believed, as measured on a labeled drive (calibrate_classes).
struct ClassReliabilityOptions {
  /// Reliability curve: at these scores, rising strictly, the class was right in this share.
  std::vector<double> scores = {0.0, 1.0};
  std::vector<double> right = {0.2, 0.9};
  /// What it was where it was wrong, relative shares: rows pedestrian, cyclist, vehicle as
  /// reported; in each row unknown, pedestrian, cyclist, vehicle, pole as it is. That of the
  /// reported class itself is not used.
  std::vector<double> mistaken = {1.0, 0.0, 1.0, 0.2, 1.0,   // pedestrian
                                  1.0, 1.0, 0.0, 0.2, 0.5,   // cyclist
                                  1.0, 0.1, 0.1, 0.0, 0.1};  // vehicle

  void visit(OptionVisitor& visitor);
  void check() const;
};

/// A detector's report as probabilities, so that Bayes over time, in the tracker, is right: the
/// share of reports of such a score that were right, and what was there where they were not. Beyond
/// its ends the curve is level; between its points straight.
class ClassReliability {
 public:
  /// Throws OptionError; also for curves of different lengths, scores that do not rise, and a table
  /// that is not 3 x 5.
  explicit ClassReliability(const Checked<ClassReliabilityOptions>& options);

  /// 0 to 1; not finite scores are worth as much as the lowest.
  double right(double score) const;

  /// Whether a report of some score is right more often than by chance (one in kObjectClasses).
  bool tellsAnything() const;

  /// Of all classes, given equal ones before; all equal for a class that no detector reports
  /// (unknown, pole), and for a score at which it is right no more often than by chance.
  ClassProbabilities probabilities(ObjectClass reported, double score) const;

 private:
  ClassReliabilityOptions options_;
};

}  // namespace datmo
