// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "datmo_fusion/common/class_belief.h"
#include "datmo_fusion/common/options.h"

namespace datmo {

/// Reliability of a detector's classes, as `evaluate calibrate_classes` measures it on
/// a labeled drive.
struct ClassReliabilityOptions {
  /// Reliability curve: scores, strictly increasing, and the share of correct classes at each.
  std::vector<double> scores = {0.0, 1.0};
  std::vector<double> right = {0.2, 0.9};
  /// Confusion: relative shares of the true class of wrong reports. Rows: reported pedestrian,
  /// cyclist, vehicle; columns: true unknown, pedestrian, cyclist, vehicle, pole. The value of the
  /// reported class itself is not used.
  std::vector<double> mistaken = {1.0, 0.0, 1.0, 0.2, 1.0,   // pedestrian
                                  1.0, 1.0, 0.0, 0.2, 0.5,   // cyclist
                                  1.0, 0.1, 0.1, 0.0, 0.1};  // vehicle

  void visit(OptionVisitor& visitor);
  void check() const;
};

/// Converts a detector's reports to probabilities, calibrated so that the tracker can fuse them by
/// Bayes: the share of correct reports at a score, and the true classes of the wrong ones. The
/// curve is linear between its points and constant beyond its ends.
class ClassReliability {
 public:
  /// Throws OptionError, also for curves of different lengths, scores that do not increase, and a
  /// table that is not 3 x 5.
  explicit ClassReliability(const Checked<ClassReliabilityOptions>& options);

  /// Share of correct reports, 0 to 1; non-finite scores count as the lowest.
  double right(double score) const;

  /// Whether reports of some score are better than chance (one in kObjectClasses).
  bool isInformative() const;

  /// Class probabilities with a uniform prior; uniform for a class that no detector reports
  /// (unknown, pole), and for a score at which reports are no better than chance.
  ClassProbabilities probabilities(ObjectClass reported, double score) const;

 private:
  ClassReliabilityOptions options_;
};

}  // namespace datmo
