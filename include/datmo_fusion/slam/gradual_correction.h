// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/common/stamp.h"

namespace datmo {

struct GradualCorrectionOptions {
  double speed = 0.5;               ///< m/s
  double turn_rate = degrees(2.0);  ///< rad/s

  void visit(OptionVisitor& visitor);
};

/// Moves one frame in another one to where it was found to be, so gradually that nothing jumps at
/// the vehicle: a turn about a distant origin alone would throw it sideways.
class GradualCorrection {
 public:
  /// Throws OptionError.
  explicit GradualCorrection(const Checked<GradualCorrectionOptions>& options);

  /// The pose of the inner frame in the outer one at this stamp, one step nearer to `target`: of
  /// the time since the last one, but no more than a second.
  /// `vehicle`: in the inner frame. At first they are the same.
  Pose2 advance(Stamp stamp, const Pose2& vehicle, const Pose2& target);

  /// As at first.
  void reset();

 private:
  GradualCorrectionOptions options_;
  Pose2 inner_in_outer_;
  std::optional<Stamp> stamp_;
};

}  // namespace datmo
