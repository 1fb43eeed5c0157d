// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/gradual_correction.h"

#include <algorithm>
#include <cmath>

namespace datmo {

namespace {

/// s; after a gap the correction continues from where it was.
constexpr double kMaxStepTime = 1.0;

}  // namespace

void GradualCorrectionOptions::visit(OptionVisitor& visitor) {
  visitor.number({"speed", "m/s", "highest speed at which a correction moves the vehicle"}, speed,
                 {0.001, 1000.0});
  visitor.number({"turn_rate", "rad/s", "highest rate at which a correction turns the vehicle"},
                 turn_rate, {0.0001, 1000.0});
}

GradualCorrection::GradualCorrection(const Checked<GradualCorrectionOptions>& options)
    : options_(*options) {}

Pose2 GradualCorrection::advance(Stamp stamp, const Pose2& vehicle, const Pose2& target) {
  const double seconds =
      std::clamp(secondsBetween(stamp_.value_or(stamp), stamp), 0.0, kMaxStepTime);
  stamp_ = stamp;
  const Pose2 now = inner_in_outer_ * vehicle;
  const Pose2 goal = target * vehicle;
  const Point2 difference = goal.position() - now.position();
  const double length = difference.norm();
  const double max_step = options_.speed * seconds;
  const double max_turn = options_.turn_rate * seconds;
  const Point2 step = length > max_step ? Point2(difference * (max_step / length)) : difference;
  const double turn = std::clamp(angleBetween(now.heading(), goal.heading()), -max_turn, max_turn);
  inner_in_outer_ = Pose2(now.position() + step, now.heading() + turn) * vehicle.inverse();
  return inner_in_outer_;
}

void GradualCorrection::reset() {
  inner_in_outer_ = {};
  stamp_.reset();
}

}  // namespace datmo
