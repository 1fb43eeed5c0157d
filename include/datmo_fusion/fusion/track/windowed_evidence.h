// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/stamp.h"

namespace datmo {

struct WindowedEvidenceOptions {
  double window = 2.0;            ///< s
  double correlation_time = 0.5;  ///< s
  double look_limit = 10.0;       ///< 1

  void visit(OptionVisitor& visitor);
};

/// Log-likelihood ratios, summed over the last `window` seconds.
///
/// The errors of a track change as slowly as its filter forgets, so that looks in quick succession
/// say the same again: the first counts in full, each later one by its share of
/// `correlation_time`. So the sum does not hang on the rate of the sensors.
class WindowedEvidence {
 public:
  /// What was seen at `stamp`, not before the last look's; limited to `look_limit` either way.
  void look(Stamp stamp, double log_likelihood_ratio, const WindowedEvidenceOptions& options);

  /// Time goes on: what is older than the window is forgotten.
  void forgetBefore(Stamp stamp, const WindowedEvidenceOptions& options);

  double sum() const { return sum_; }

  /// Nothing is left in the window.
  bool empty() const { return looks_.empty(); }

 private:
  struct Look {
    Stamp stamp;
    double value;
  };
  std::deque<Look> looks_;  ///< rising stamps
  double sum_ = 0.0;
};

}  // namespace datmo
