// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/PointCloud2.h>

#include "datmo_fusion/ros/stage/input_error.h"
#include "datmo_fusion/sensor_model/stereo_cloud.h"

namespace datmo {

/// The points of a message, in place if their layout suits a PointsView, else copied.
class CloudPoints {
 public:
  /// The points are not copied unless rows are padded. `message` must outlive this.
  ///
  /// Throws InputError: `empty_cloud` (no points), `missing_field` (x, y or z), `wrong_field_type`
  /// (they are not FLOAT32, or reach beyond the point), `big_endian`, `wrong_size` (less data than
  /// width, height and steps say), `no_valid_point` (none is finite).
  explicit CloudPoints(const sensor_msgs::PointCloud2& message);
  explicit CloudPoints(sensor_msgs::PointCloud2&& message) = delete;

  CloudPoints(const CloudPoints&) = delete;
  CloudPoints& operator=(const CloudPoints&) = delete;

  const PointsView& view() const { return view_; }

  /// Transforms the points to another frame; they are copied.
  void transform(const Eigen::Isometry3d& cloud_in_frame);

  /// Adds `shift` (1/m) to the inverse of each z, along its line of sight, to correct a disparity
  /// bias. Points without a depth afterward become non-finite. The points are not copied.
  void shiftInverseDepths(double shift) { view_.inverse_shift += static_cast<float>(shift); }

  /// Removes the points whose z (m) is outside `min_depth` to `max_depth`, 0: no upper bound; the
  /// others are copied. Throws InputError (`no_valid_point`) if none remains.
  void keepDepths(double min_depth, double max_depth);

 private:
  void packRows(const sensor_msgs::PointCloud2& message);
  /// Replaces the points by x, y and z, 4 bytes each.
  void replace(std::vector<std::uint8_t> packed);

  PointsView view_;
  std::vector<std::uint8_t> copy_;
};

/// Plausible range of a stereo camera's geometry.
inline constexpr double kMinFocalLength = 10.0;  ///< px
inline constexpr double kMaxFocalLength = 1e5;   ///< px
inline constexpr double kMinBaseline = 0.005;    ///< m
inline constexpr double kMaxBaseline = 10.0;     ///< m

/// Returns the geometry of a rectified pair from the right camera's info: focal length P[0],
/// baseline -P[3] / P[0], image borders from its width, its region of interest and P[2]. Binning is
/// taken into account. The depth noise is left at 0: no message contains it.
///
/// Throws InputError (`bad_camera_info`) for values that no stereo camera has, including the left
/// camera's info, whose baseline is 0.
StereoCamera stereoCamera(const sensor_msgs::CameraInfo& right);

/// The same for the info of a depth image, which has no baseline: it is left at 0.
StereoCamera depthCamera(const sensor_msgs::CameraInfo& info);

}  // namespace datmo
