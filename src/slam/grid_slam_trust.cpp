// SPDX-License-Identifier: BSD-3-Clause
// What GridSlam does about odometry that is wrong.
#include "datmo_fusion/slam/grid_slam.h"

namespace datmo {

Scan GridSlam::checkOdometry(const Measurement& measurement, const PoseFilter& before,
                             double seconds, const Scan& scan, SlamResult& result) {
  const Stamp stamp = measurement.scan.stamp;
  const auto motion = odometry_.motion(stamp + -seconds, stamp, before.errors());
  if (!motion) {
    trust_.interrupt();
    return scan;
  }
  trust_.observeFrom(stamp + -seconds, before);
  trust_.predict(*motion, seconds);
  const Scan by_scans = compensated(measurement.scan, trust_.byScans().velocity());
  const MatchQuality match = correct(trust_.byScans(), measurement, by_scans, false, trust_random_);
  trust_.judge(stamp);
  result.odometry_contradiction = trust_.contradiction();
  result.odometry_trusted = trust_.isTrusted();
  Scan used = scan;
  if (!result.odometry_trusted) {
    filter_ = trust_.byScans();
    result.match = match;
    result.odometry_used = false;
    used = compensated(measurement.scan, filter_.velocity());
  }
  trust_.endWindow(stamp);
  return used;
}

}  // namespace datmo
