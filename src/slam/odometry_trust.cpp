// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/odometry_trust.h"

#include "datmo_fusion/slam/pose_distance.h"

namespace datmo {

void OdometryTrustOptions::visit(OptionVisitor& visitor) {
  visitor.number({"window", "s",
                  "over which the motion by odometry alone and by scans alone are compared, and "
                  "have to agree again: in a longer one smaller errors of the odometry show, in a "
                  "shorter one they cost less until then"},
                 window, {0.1, 10.0});
}

void OdometryTrust::observeFrom(Stamp stamp, const PoseFilter& vehicle) {
  if (window_) {
    return;
  }
  window_.emplace(Window{stamp, vehicle, vehicle});
  // What scans teach about the pose is not to teach anything about odometry, which is not used.
  window_->by_scans.restartAt(vehicle.pose());
}

void OdometryTrust::predict(const Pose2& motion, double seconds) {
  window_->by_scans.predictUnmeasured(seconds);
  window_->by_odometry.predictMeasured(motion, seconds);
}

void OdometryTrust::judge(Stamp stamp, const std::function<bool()>& scans_fit_better) {
  contradiction_ = squaredDistance(window_->by_odometry.pose(), window_->by_scans.pose());
  if (contradiction_ > kContradiction && scans_fit_better()) {
    contradicted_ = stamp;
  }
  is_trusted_ = !contradicted_ || secondsBetween(*contradicted_, stamp) > options_.window;
}

void OdometryTrust::endWindow(Stamp stamp) {
  if (contradiction_ > kContradiction || secondsBetween(window_->begun, stamp) > options_.window) {
    window_.reset();
  }
}

}  // namespace datmo
