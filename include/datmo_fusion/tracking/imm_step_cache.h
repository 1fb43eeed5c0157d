// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "datmo_fusion/tracking/imm_filter.h"

namespace datmo {

/// The most recent steps, to be reused for sensors with a constant period.
class ImmStepCache {
 public:
  explicit ImmStepCache(const ImmOptions& options) : options_(options) {}

  /// See immSteps(). Valid until the next call.
  const ImmSteps& of(double seconds) {
    if (!steps_ || steps_->front().seconds != seconds) {
      steps_ = immSteps(options_, seconds);
    }
    return *steps_;
  }

 private:
  ImmOptions options_;
  std::optional<ImmSteps> steps_;
};

}  // namespace datmo
