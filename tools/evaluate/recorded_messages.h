// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "evaluate/recorded_data.h"
#include <datmo_fusion/RoadBorders.h>

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <nav_msgs/Odometry.h>

#include "datmo_fusion/ros/convert/messages.h"

namespace datmo::evaluation {

// Converts messages for the evaluation. All functions throw InputError for what cannot be scored: a
// number that is not finite, an invalid pose, a negative size, a repeated id in one message.

RecordedTracks toRecorded(const TrackArray& message);
RecordedObjects toRecorded(const TrueObjectArray& message);

/// Those that are published as moving.
RecordedDetections toRecorded(const ObjectArray& message);

StampedPose toRecorded(const geometry_msgs::PoseWithCovarianceStamped& message);

/// For a true pose; its covariance is ignored.
StampedPose toRecorded(const nav_msgs::Odometry& message);

RecordedIntersection toRecorded(const datmo_fusion::RoadBorders& message);
RecordedIntersection toRecorded(const TrueRoadBorders& message);

}  // namespace datmo::evaluation
