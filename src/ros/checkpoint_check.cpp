// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/checkpoint_check.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "datmo_fusion/common/physical_bounds.h"
#include "datmo_fusion/ros/stage/output_check.h"
#include "datmo_fusion/ros/stage/stamp_range.h"

namespace datmo {

namespace {

/// s, mean interval of scans. Far more than that of any scanner, since a gap counts in the mean
/// with a tenth of its duration: one hour is that of ten hours without a scan.
constexpr double kMaxScanInterval = 3600.0;

template <int kSize>
bool isSound(const Eigen::Matrix<double, kSize, kSize>& covariance) {
  return isWithin(covariance, kMaxCoordinate * kMaxCoordinate) &&
         isCovariance(covariance.data(), kSize);
}

bool isSound(const std::vector<OdometrySample>& samples) {
  const bool ascend = std::is_sorted(
      samples.begin(), samples.end(),
      [](const OdometrySample& a, const OdometrySample& b) { return a.stamp < b.stamp; });
  return ascend && std::all_of(samples.begin(), samples.end(), [](const OdometrySample& sample) {
           return isInStampRange(sample.stamp) && isPlausible(sample.twist) &&
                  isWithin(sample.base_in_odom.value_or(Pose2()).position(), kMaxCoordinate);
         });
}

bool isSound(const PoseFilter::Estimate& estimate) {
  return isWithin(estimate.pose.position(), kMaxCoordinate) && isPlausible(estimate.velocity) &&
         std::abs(estimate.errors.speed_scale) < 1.0 &&
         std::abs(estimate.errors.yaw_rate_bias) <= kMaxYawRate && isSound(estimate.covariance);
}

}  // namespace

bool isSound(const SlamState& slam) {
  return isInStampRange(slam.pose.stamp) && slam.pose.scan_interval > 0.0 &&
         slam.pose.scan_interval <= kMaxScanInterval && isSound(slam.pose.estimate) &&
         isSound(slam.pose.odometry) && isSound(slam.map.drift) && isSound(slam.map.frame) &&
         slam.map.maps_begun >= 0;
}

}  // namespace datmo
