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

/// Sum of log-likelihood ratios over the last `window` seconds.
///
/// Track errors change slowly, at the time constant of the filter, so observations in quick
/// succession repeat the same information: the first counts in full, each later one by its share of
/// `correlation_time`. So the sum does not depend on the rate of the sensors.
class WindowedEvidence {
 public:
  /// Adds the evidence at `stamp`, not before the last one's; limited to +-`look_limit`.
  void look(Stamp stamp, double log_likelihood_ratio, const WindowedEvidenceOptions& options);

  /// Removes evidence older than the window.
  void forgetBefore(Stamp stamp, const WindowedEvidenceOptions& options);

  double sum() const { return sum_; }

  /// Whether nothing is left in the window.
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
