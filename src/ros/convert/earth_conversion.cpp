// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/convert/earth_conversion.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <sensor_msgs/NavSatStatus.h>

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/common/covariance_check.h"
#include "datmo_fusion/common/physical_bounds.h"
#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/stage/input_error.h"
#include "datmo_fusion/ros/stage/stamp_check.h"

namespace datmo {

namespace {

using Matrix3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;  ///< memory layout of messages
using Matrix4 = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;

template <typename Message>
GeodeticPosition geodetic(const Message& message, double altitude) {
  return {degrees(message.latitude), degrees(message.longitude), altitude};
}

datmo_fusion::StationTrack toMessage(const StationTrack& track, const LocalPlane& plane) {
  const GeodeticPosition position = plane.toGeodetic(track.position);
  datmo_fusion::StationTrack message;
  message.id = track.id;
  message.latitude = toDegrees(position.latitude);
  message.longitude = toDegrees(position.longitude);
  message.velocity_east = track.velocity.x();
  message.velocity_north = track.velocity.y();
  Eigen::Map<Matrix4>(message.covariance.data()) = track.covariance;
  message.heading = track.heading;
  message.heading_variance = track.heading_variance;
  message.length = static_cast<float>(track.length);
  message.width = static_cast<float>(track.width);
  message.height = static_cast<float>(track.height);
  message.moving = track.moving;
  message.class_probabilities.assign(track.class_probabilities.begin(),
                                     track.class_probabilities.end());
  message.existence_probability = static_cast<float>(track.existence_probability);
  return message;
}

StationTrack fromMessage(const datmo_fusion::StationTrack& message, const LocalPlane& plane) {
  StationTrack track;
  track.id = message.id;
  const GeodeticPosition position = geodetic(message, plane.datum().altitude);
  track.position = isValid(position) ? plane.toPlane(position)
                                     : Point2::Constant(std::numeric_limits<double>::quiet_NaN());
  track.velocity = {message.velocity_east, message.velocity_north};
  track.covariance = Eigen::Map<const Matrix4>(message.covariance.data());
  track.heading = message.heading;
  track.heading_variance = message.heading_variance;
  track.length = message.length;
  track.width = message.width;
  track.height = message.height;
  track.moving = message.moving != 0;
  if (message.class_probabilities.size() == track.class_probabilities.size()) {
    std::copy(message.class_probabilities.begin(), message.class_probabilities.end(),
              track.class_probabilities.begin());
  } else {
    track.class_probabilities.fill(1.0 / static_cast<double>(kObjectClasses));
  }
  track.existence_probability = message.existence_probability;
  return track;
}

/// m^2; variances outside this range mean that the covariance was not filled in.
constexpr double kMinFixVariance = 1e-8;
constexpr double kMaxFixVariance = 1e14;

/// Id of our own track.
constexpr std::uint32_t kOwnId = 0;

}  // namespace

EarthFrameMessage toMessage(const EarthFrame& frame, const std::string& map_frame) {
  EarthFrameMessage message;
  message.header.stamp = toTime(frame.stamp);
  message.header.frame_id = map_frame;
  message.latitude = toDegrees(frame.plane.datum().latitude);
  message.longitude = toDegrees(frame.plane.datum().longitude);
  message.altitude = frame.plane.datum().altitude;
  message.pose.x = frame.map_in_plane.pose.x();
  message.pose.y = frame.map_in_plane.pose.y();
  message.pose.theta = frame.map_in_plane.pose.heading();
  Eigen::Map<Matrix3>(message.covariance.data()) = frame.map_in_plane.covariance;
  return message;
}

EarthFrame fromMessage(const EarthFrameMessage& message) {
  const GeodeticPosition datum = geodetic(message, message.altitude);
  const Eigen::Matrix3d covariance = Eigen::Map<const Matrix3>(message.covariance.data());
  const Pose2 pose(message.pose.x, message.pose.y, message.pose.theta);
  const bool is_near = isWithin(pose.position(), kMaxCoordinate) &&
                       isWithin(covariance, kMaxCoordinate * kMaxCoordinate);
  if (!isValid(datum) || !is_near || !std::isfinite(pose.heading()) || !isCovariance(covariance)) {
    throw InputError("bad_earth_frame",
                     "the map's pose on the earth at " + std::to_string(message.pose.x) + ", " +
                         std::to_string(message.pose.y) +
                         ", or its covariance, is invalid: expected finite numbers within 20000 km "
                         "and a positive definite covariance");
  }
  return {toStamp(message.header.stamp), LocalPlane(datum), {pose, covariance}};
}

GeodeticPosition positionOf(const sensor_msgs::NavSatFix& message) {
  if (message.status.status < sensor_msgs::NavSatStatus::STATUS_FIX) {
    throw InputError("no_fix", "the receiver reports that it has no position (status " +
                                   std::to_string(message.status.status) + ")");
  }
  // A receiver without height may report NaN.
  const double altitude = std::isfinite(message.altitude) ? message.altitude : 0.0;
  const GeodeticPosition position = geodetic(message, altitude);
  if (!isValid(position)) {
    throw InputError("bad_position", "latitude " + std::to_string(message.latitude) +
                                         " deg, longitude " + std::to_string(message.longitude) +
                                         " deg, altitude " + std::to_string(message.altitude) +
                                         " m: expected a position on the earth");
  }
  return position;
}

Eigen::Matrix2d covarianceOf(const sensor_msgs::NavSatFix& message, double sigma) {
  constexpr int kRow = 3;  // of east, north, up
  const auto& values = message.position_covariance;
  Eigen::Matrix2d covariance;
  covariance << values[0], values[1], values[kRow], values[kRow + 1];
  const bool is_known =
      message.position_covariance_type != sensor_msgs::NavSatFix::COVARIANCE_TYPE_UNKNOWN &&
      isCovariance(covariance) && covariance.diagonal().minCoeff() >= kMinFixVariance &&
      covariance.diagonal().maxCoeff() <= kMaxFixVariance;
  return is_known ? covariance : Eigen::Matrix2d(sigma * sigma * Eigen::Matrix2d::Identity());
}

StationTracksMessage toMessage(const StationTrackList& list, const LocalPlane& plane) {
  StationTracksMessage message;
  message.header.stamp = toTime(list.stamp);
  message.station = list.station;
  message.part = list.part;
  message.clock_sigma = list.clock_sigma;
  for (const StationTrack& track : list.tracks) {
    message.tracks.push_back(toMessage(track, plane));
  }
  return message;
}

StationTrackList fromMessage(const StationTracksMessage& message, const LocalPlane& plane) {
  StationTrackList list;
  list.stamp = toStamp(message.header.stamp);
  list.station = message.station;
  list.part = message.part;
  list.clock_sigma = std::isfinite(message.clock_sigma) ? message.clock_sigma : 0.0;
  for (const datmo_fusion::StationTrack& track : message.tracks) {
    list.tracks.push_back(fromMessage(track, plane));
  }
  return list;
}

std::optional<OwnTrack> ownTrack(const StationTracksMessage& message) {
  const auto own = std::find_if(message.tracks.begin(), message.tracks.end(),
                                [](const auto& track) { return track.id == kOwnId; });
  if (own == message.tracks.end()) {
    return std::nullopt;
  }
  const GeodeticPosition position = geodetic(*own, 0.0);
  if (!isValid(position)) {
    return std::nullopt;
  }
  const LocalPlane plane(position);
  return OwnTrack{plane, fromMessage(*own, plane)};
}

}  // namespace datmo
