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

/// The pose seen from above; roll and pitch are left out. Throws InputError (`bad_pose`) if it is
/// not finite, farther away than 1e9 m, or its quaternion is not of length 1.
Pose2 fromMessage(const geometry_msgs::Pose& pose);

/// The covariance of x, y and yaw, as it is.
Eigen::Matrix3d planarCovariance(const geometry_msgs::PoseWithCovariance& pose);

/// Both. Throws InputError (`bad_pose`) for an invalid covariance, too.
PoseWithCovariance fromMessage(const geometry_msgs::PoseWithCovariance& pose);

geometry_msgs::TransformStamped toTransform(const Pose2& child_in_parent, Stamp stamp,
                                            const std::string& parent_frame,
                                            const std::string& child_frame);

/// Throws InputError (`bad_odometry`) if speed or yaw rate is not finite, or beyond that of any
/// vehicle.
OdometrySample toSample(const nav_msgs::Odometry& message);

/// A value without a name is kUnknown.
ObjectClass classFromMessage(std::uint8_t value);

LabeledScanMessage toMessage(const LabeledScan& scan, const std::string& base_frame,
                             const std::string& map_frame);

/// Throws InputError: `bad_pose` for one of the vehicle or the scanner, `bad_field` for one of the
/// beams, `bad_point` for points that are not finite or of no known state.
LabeledScan fromMessage(const LabeledScanMessage& message);

ObjectArray toMessage(const ObjectList& list, const std::string& base_frame);

/// No check beyond the enumerations: a value without a name becomes kUnknown. The tracker judges
/// the numbers of each object by itself. A field of view that is none is left out.
ObjectList fromMessage(const ObjectArray& message);

/// Without Track::objects, which the message does not have.
TrackArray toMessage(const TrackList& list, const std::string& fixed_frame);

/// The inverse, to the message's precision (probabilities and views are single). No check of the
/// tracks: whoever takes them judges each by itself (isValid), and one whose probabilities are of
/// the wrong number has NaN for them, which is not valid. A view that is none (isValid) is left
/// out.
TrackList fromMessage(const TrackArray& message);

/// The window of the map as it lies now: cell (0, 0) of the message is the window's lower left one.
nav_msgs::OccupancyGrid toMessage(const OccupancyMap& map, Stamp stamp,
                                  const std::string& map_frame);

}  // namespace datmo
