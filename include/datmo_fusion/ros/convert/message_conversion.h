// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include <geometry_msgs/Pose.h>
#include <geometry_msgs/PoseWithCovariance.h>
#include <geometry_msgs/TransformStamped.h>
#include <nav_msgs/OccupancyGrid.h>
#include <nav_msgs/Odometry.h>

#include "datmo_fusion/common/object.h"
#include "datmo_fusion/common/scan.h"
#include "datmo_fusion/grid/occupancy_map.h"
#include "datmo_fusion/ros/convert/messages.h"
#include "datmo_fusion/slam/odometry_buffer.h"
#include "datmo_fusion/tracking/track.h"

namespace datmo {

geometry_msgs::Pose toMessage(const Pose2& pose);
geometry_msgs::PoseWithCovariance toMessage(const PoseWithCovariance& pose);

/// Returns the planar pose; roll and pitch are dropped. Throws InputError (`bad_pose`) if it is not
/// finite, farther away than kMaxCoordinate, or its quaternion does not have length 1.
Pose2 fromMessage(const geometry_msgs::Pose& pose);

/// Returns the covariance of x, y and yaw, unchecked.
Eigen::Matrix3d planarCovariance(const geometry_msgs::PoseWithCovariance& pose);

/// Converts both. Also throws InputError (`bad_pose`) for an invalid covariance.
PoseWithCovariance fromMessage(const geometry_msgs::PoseWithCovariance& pose);

geometry_msgs::TransformStamped toTransform(const Pose2& child_in_parent, Stamp stamp,
                                            const std::string& parent_frame,
                                            const std::string& child_frame);

/// Throws InputError (`bad_odometry`) if speed or yaw rate is not finite, or beyond that of any
/// vehicle.
OdometrySample toSample(const nav_msgs::Odometry& message);

/// Converts a class; an undefined value becomes kUnknown.
ObjectClass classFromMessage(std::uint8_t value);

LabeledScanMessage toMessage(const LabeledScan& scan, const std::string& base_frame,
                             const std::string& map_frame);

/// Throws InputError: `bad_pose` for a pose of the vehicle or the scanner, `bad_field` for a bad
/// field of view, `bad_point` for points that are not finite or have an undefined state.
LabeledScan fromMessage(const LabeledScanMessage& message);

ObjectArray toMessage(const ObjectList& list, const std::string& base_frame);

/// Checks only enumerations: an undefined value becomes kUnknown. The tracker checks the numbers of
/// each object. An invalid field of view is dropped.
ObjectList fromMessage(const ObjectArray& message);

/// Omits Track::objects, which the message does not have.
TrackArray toMessage(const TrackList& list, const std::string& fixed_frame);

/// The inverse, to the message's precision (probabilities and views are single). Tracks are not
/// checked: each consumer validates them (isValid), and a track with the wrong number of
/// probabilities gets NaN for them, which is invalid. An invalid view (isValid) is dropped.
TrackList fromMessage(const TrackArray& message);

/// The current window of the map: cell (0, 0) of the message is the window's lower left one.
nav_msgs::OccupancyGrid toMessage(const OccupancyMap& map, Stamp stamp,
                                  const std::string& map_frame);

}  // namespace datmo
