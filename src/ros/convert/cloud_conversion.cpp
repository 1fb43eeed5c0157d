// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/convert/cloud_conversion.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <sstream>
#include <string>
#include <utility>

namespace datmo {

namespace {

using sensor_msgs::CameraInfo;
using sensor_msgs::PointCloud2;
using sensor_msgs::PointField;

/// Indices in P (3 x 4, row by row) of a camera info.
constexpr std::size_t kFocalLength = 0;
constexpr std::size_t kImageCenter = 2;
constexpr std::size_t kBaseline = 3;  // times -focal length

/// The center of the first pixel is at 0, so the image begins this much before it (px).
constexpr double kHalfPixel = 0.5;

/// Tangent of half of the maximum field of view: 85 degrees.
constexpr double kMaxTangent = 12.0;

constexpr std::size_t kPackedStep = 3 * sizeof(float);

template <typename... Parts>
[[noreturn]] void refuse(const std::string& reason, const Parts&... parts) {
  std::ostringstream text;
  (text << ... << parts);
  throw InputError(reason, text.str());
}

/// Offset in bytes of the field with this name within a point.
std::size_t offsetOf(const std::string& name, const PointCloud2& message) {
  const auto field = std::find_if(message.fields.begin(), message.fields.end(),
                                  [&name](const PointField& f) { return f.name == name; });
  if (field == message.fields.end()) {
    refuse("missing_field", "cloud without field ", name, ": expected x, y and z");
  }
  if (field->datatype != PointField::FLOAT32) {
    refuse("wrong_field_type", "cloud with field ", name, " of type ", int{field->datatype},
           ": expected ", int{PointField::FLOAT32}, " (FLOAT32)");
  }
  if (std::uint64_t{field->offset} + sizeof(float) > message.point_step) {
    refuse("wrong_field_type", "cloud with field ", name, " at byte ", field->offset,
           " of points of ", message.point_step, " bytes: expected it inside the point");
  }
  return field->offset;
}

/// Bytes of a row without padding.
std::uint64_t rowBytes(const PointCloud2& message) {
  return std::uint64_t{message.width} * message.point_step;
}

void checkSize(const PointCloud2& message) {
  if (message.width == 0 || message.height == 0) {
    refuse("empty_cloud", "cloud of ", message.width, " x ", message.height,
           " points: expected at least one");
  }
  // A cloud of one row needs no valid row step.
  const std::uint64_t rows_before = std::uint64_t{message.height} - 1;
  if (rows_before > 0 && message.row_step < rowBytes(message)) {
    refuse("wrong_size", "cloud with rows of ", message.row_step, " bytes: expected at least ",
           rowBytes(message), " for ", message.width, " points of ", message.point_step, " bytes");
  }
  const std::uint64_t expected = rows_before * message.row_step + rowBytes(message);
  if (message.data.size() < expected) {
    refuse("wrong_size", "cloud of ", message.width, " x ", message.height, " points with ",
           message.data.size(), " bytes: expected at least ", expected);
  }
}

void checkPoints(const PointsView& points) {
  for (std::size_t i = 0; i < points.count; ++i) {
    if (points[i].allFinite()) {
      return;
    }
  }
  refuse("no_valid_point", "cloud of ", points.count, " points, none of them finite");
}

/// False for NaN.
bool isBetween(double value, double min, double max) { return value >= min && value <= max; }

/// Focal length and image borders.
StereoCamera pinholeCamera(const CameraInfo& info) {
  // Binning of 0 means 1 according to the message definition.
  const double binning = std::max(1U, info.binning_x);
  const double full_focal_length = info.P[kFocalLength];
  StereoCamera camera;
  camera.focal_length = full_focal_length / binning;
  const double first = info.roi.x_offset - kHalfPixel;
  const double columns = info.roi.width > 0 ? info.roi.width : info.width;
  camera.left_tangent = (first - info.P[kImageCenter]) / full_focal_length;
  camera.right_tangent = (first + columns - info.P[kImageCenter]) / full_focal_length;
  return camera;
}

bool isValid(const StereoCamera& camera) {
  return isBetween(camera.focal_length, kMinFocalLength, kMaxFocalLength) &&
         isBetween(camera.left_tangent, -kMaxTangent, kMaxTangent) &&
         isBetween(camera.right_tangent, -kMaxTangent, kMaxTangent) &&
         camera.left_tangent < camera.right_tangent;
}

}  // namespace

CloudPoints::CloudPoints(const PointCloud2& message) {
  checkSize(message);
  if (message.is_bigendian) {
    refuse("big_endian", "cloud of big-endian numbers: expected little-endian ones");
  }
  view_.count = std::size_t{message.width} * message.height;
  view_.step = message.point_step;
  view_.x_offset = offsetOf("x", message);
  view_.y_offset = offsetOf("y", message);
  view_.z_offset = offsetOf("z", message);
  const bool padded = message.height > 1 && message.row_step != rowBytes(message);
  if (padded) {
    packRows(message);
  } else {
    view_.data = message.data.data();
  }
  checkPoints(view_);
}

void CloudPoints::packRows(const PointCloud2& message) {
  const auto row_bytes = static_cast<std::ptrdiff_t>(rowBytes(message));
  copy_.reserve(static_cast<std::size_t>(row_bytes) * message.height);
  auto row = message.data.begin();
  for (std::uint32_t i = 0; i < message.height; ++i) {
    copy_.insert(copy_.end(), row, row + row_bytes);
    row += std::min<std::ptrdiff_t>(message.row_step, message.data.end() - row);
  }
  view_.data = copy_.data();
}

void CloudPoints::transform(const Eigen::Isometry3d& cloud_in_frame) {
  const Eigen::Isometry3f motion = cloud_in_frame.cast<float>();
  std::vector<std::uint8_t> moved(view_.count * kPackedStep);
  for (std::size_t i = 0; i < view_.count; ++i) {
    const Eigen::Vector3f point = motion * view_[i];
    std::memcpy(moved.data() + i * kPackedStep, point.data(), kPackedStep);
  }
  replace(std::move(moved));
}

void CloudPoints::keepDepths(double min_depth, double max_depth) {
  const double limit = max_depth > 0.0 ? max_depth : std::numeric_limits<double>::max();
  std::vector<std::uint8_t> kept(view_.count * kPackedStep);
  std::size_t size = 0;
  for (std::size_t i = 0; i < view_.count; ++i) {
    const Eigen::Vector3f point = view_[i];
    if (isBetween(point.z(), min_depth, limit)) {
      std::memcpy(kept.data() + size, point.data(), kPackedStep);
      size += kPackedStep;
    }
  }
  if (size == 0) {
    refuse("no_valid_point", "cloud of ", view_.count, " points, none of them from ", min_depth,
           " to ", limit,
           " m ahead of the camera: expected points in its optical frame (REP 103: z "
           "ahead) and within stereo_camera/min_depth and max_depth");
  }
  kept.resize(size);
  replace(std::move(kept));
}

void CloudPoints::replace(std::vector<std::uint8_t> packed) {
  copy_ = std::move(packed);
  view_ = PointsView();
  view_.data = copy_.data();
  view_.count = copy_.size() / kPackedStep;
  view_.step = kPackedStep;
}

StereoCamera stereoCamera(const CameraInfo& right) {
  StereoCamera camera = pinholeCamera(right);
  camera.baseline = -right.P[kBaseline] / right.P[kFocalLength];
  if (!isValid(camera) || !isBetween(camera.baseline, kMinBaseline, kMaxBaseline)) {
    refuse("bad_camera_info", "camera info with a focal length of ", camera.focal_length,
           " px, a baseline of ", camera.baseline, " m, and a view from ", camera.left_tangent,
           " to ", camera.right_tangent, " (tangents): expected the right camera's, with ",
           kMinFocalLength, " to ", kMaxFocalLength, " px and ", kMinBaseline, " to ", kMaxBaseline,
           " m; a depth camera has no baseline: set stereo_camera/depth_noise");
  }
  return camera;
}

StereoCamera depthCamera(const CameraInfo& info) {
  const StereoCamera camera = pinholeCamera(info);
  if (!isValid(camera)) {
    refuse("bad_camera_info", "camera info with a focal length of ", camera.focal_length,
           " px, and a view from ", camera.left_tangent, " to ", camera.right_tangent,
           " (tangents): expected the depth image's, with ", kMinFocalLength, " to ",
           kMaxFocalLength, " px in P");
  }
  return camera;
}

}  // namespace datmo
