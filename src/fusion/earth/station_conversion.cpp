// SPDX-License-Identifier: BSD-3-Clause
// Converts tracks between an east-north plane and the map, including the uncertainty of both.
#include <algorithm>
#include <string>

#include "datmo_fusion/common/perpendicular.h"
#include "datmo_fusion/common/square.h"
#include "datmo_fusion/fusion/earth/station_tracks.h"

namespace datmo {

namespace {

/// Rotation of position and velocity from the plane to the map, or vice versa.
Eigen::Matrix4d rotationOfBoth(const Eigen::Matrix2d& rotation) {
  Eigen::Matrix4d both = Eigen::Matrix4d::Zero();
  both.topLeftCorner<2, 2>() = rotation;
  both.bottomRightCorner<2, 2>() = rotation;
  return both;
}

}  // namespace

Track StationTracks::inMap(const StationTrackList& list, const StationTrack& theirs,
                           const PoseWithCovariance& map_in_plane) const {
  const Pose2 plane_in_map = map_in_plane.pose.inverse();
  const Eigen::Matrix2d to_map = plane_in_map.rotation();
  const double clock = list.clock_sigma > 0.0 ? list.clock_sigma : options_.clock_sigma;
  const Point2 position = plane_in_map * theirs.position;
  const Point2 velocity = to_map * theirs.velocity;
  Eigen::Matrix<double, 4, 3> by_frame;           // of the map's x, y and heading in the plane
  by_frame << -to_map, -perpendicular(position),  //
      Eigen::Matrix2d::Zero(), -perpendicular(velocity);
  Eigen::Vector4d by_clock;
  by_clock << velocity, Point2::Zero();
  Eigen::Matrix4d covariance =
      rotationOfBoth(to_map) * theirs.covariance * rotationOfBoth(to_map).transpose() +
      by_frame * map_in_plane.covariance * by_frame.transpose() +
      square(clock) * by_clock * by_clock.transpose();
  const double min_position_variance = square(options_.min_position_sigma);
  const double min_velocity_variance = square(options_.min_velocity_sigma);
  for (int axis = 0; axis < 2; ++axis) {
    covariance(axis, axis) += std::max(0.0, min_position_variance - covariance(axis, axis));
    covariance(2 + axis, 2 + axis) +=
        std::max(0.0, min_velocity_variance - covariance(2 + axis, 2 + axis));
  }
  Track track;
  track.id = claims_.at({list.station, theirs.id}).id;
  track.state << position, velocity, Point2::Zero();
  track.covariance.setZero();
  track.covariance.topLeftCorner<4, 4>() = 0.5 * (covariance + covariance.transpose());
  track.covariance.bottomRightCorner<2, 2>() =
      square(options_.acceleration_sigma) * Eigen::Matrix2d::Identity();
  track.box = {Pose2(position, theirs.heading + plane_in_map.heading()), theirs.length,
               theirs.width};
  track.height = theirs.height;
  track.heading_variance = theirs.heading_variance + map_in_plane.covariance(2, 2);
  track.moving = theirs.moving;
  track.class_probabilities = theirs.class_probabilities;
  track.existence_probability = theirs.existence_probability;
  track.sensors = {"station " + std::to_string(list.station)};
  return track;
}

StationTrack toStation(const Track& track, const PoseWithCovariance& map_in_plane) {
  const Eigen::Matrix2d to_plane = map_in_plane.pose.rotation();
  StationTrack ours;
  ours.id = track.id;
  ours.position = map_in_plane.pose * track.box.center.position();
  ours.velocity = to_plane * track.state.segment<2>(2);
  Eigen::Matrix<double, 4, 3> by_frame;
  by_frame << Eigen::Matrix2d::Identity(),
      perpendicular(to_plane * track.box.center.position()),  //
      Eigen::Matrix2d::Zero(), perpendicular(ours.velocity);
  const Eigen::Matrix4d covariance = rotationOfBoth(to_plane) *
                                         track.covariance.topLeftCorner<4, 4>() *
                                         rotationOfBoth(to_plane).transpose() +
                                     by_frame * map_in_plane.covariance * by_frame.transpose();
  ours.covariance = 0.5 * (covariance + covariance.transpose());
  ours.heading = normalizeAngle(track.box.center.heading() + map_in_plane.pose.heading());
  ours.heading_variance = track.heading_variance + map_in_plane.covariance(2, 2);
  ours.length = track.box.length;
  ours.width = track.box.width;
  ours.height = track.height;
  ours.moving = track.moving;
  ours.class_probabilities = track.class_probabilities;
  ours.existence_probability = track.existence_probability;
  return ours;
}

}  // namespace datmo
