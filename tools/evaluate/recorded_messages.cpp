// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/recorded_messages.h"

#include <set>
#include <sstream>
#include <string>

#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/stage/input_error.h"
#include "datmo_fusion/ros/stage/stamp_check.h"

namespace datmo::evaluation {

namespace {

/// Of position and velocity, the first rows and columns of a track's covariance.
constexpr int kScoredState = 4;
constexpr int kTrackStateSize = 6;

template <typename Vector>
void checkFinite(const std::string& what, const Vector& values) {
  if (!values.allFinite()) {
    std::ostringstream message;
    message << what << " is [" << values.transpose() << "]: expected finite numbers";
    throw InputError("not_finite", message.str());
  }
}

/// Reports only the variances if these are wrong.
template <typename Matrix>
void checkCovariance(const Matrix& covariance) {
  checkFinite("diagonal of the covariance", covariance.diagonal());
  checkFinite("covariance",
              Eigen::Map<const Eigen::VectorXd>(covariance.data(), covariance.size()));
}

Point2 planar(const std::string& what, const geometry_msgs::Vector3& message) {
  const Point2 vector(message.x, message.y);
  checkFinite(what, vector);
  return vector;
}

Box2 box(const geometry_msgs::Pose& pose, const geometry_msgs::Vector3& size) {
  const Point2 extent = planar("size", size);
  if (extent.minCoeff() < 0.0) {
    throw InputError("bad_size", "size is " + std::to_string(extent.x()) + " m x " +
                                     std::to_string(extent.y()) + " m: expected at least 0");
  }
  return {fromMessage(pose), extent.x(), extent.y()};
}

TrackState stateOf(const TrackMessage& message) {
  using Covariance = Eigen::Matrix<double, kTrackStateSize, kTrackStateSize, Eigen::RowMajor>;
  TrackState state;
  state.id = message.id;
  state.classification = classFromMessage(message.classification);
  state.box = box(message.pose, message.size);
  state.velocity = planar("velocity", message.velocity);
  state.covariance = Eigen::Map<const Covariance>(message.covariance.data())
                         .topLeftCorner<kScoredState, kScoredState>();
  checkCovariance(state.covariance);
  state.sensors = message.sensors.size();
  return state;
}

TrueState stateOf(const TrueObject& message) {
  TrueState state;
  state.id = message.id;
  state.classification = classFromMessage(message.classification);
  state.box = box(message.pose, message.size);
  state.velocity = planar("velocity", message.velocity);
  return state;
}

/// Reads the part of a message that has an id; errors name this id.
template <typename Item>
auto readState(const std::string& what, const Item& item, std::set<std::uint32_t>& ids) {
  const std::string name = what + " " + std::to_string(item.id);
  if (!ids.insert(item.id).second) {
    throw InputError("repeated_id", name + " twice: expected each id once in a message");
  }
  try {
    return stateOf(item);
  } catch (const InputError& error) {
    throw InputError(error.reason(), name + ": " + error.what());
  }
}

}  // namespace

RecordedTracks toRecorded(const TrackArray& message) {
  RecordedTracks recorded{toStamp(message.header.stamp), {}};
  std::set<std::uint32_t> ids;
  for (const TrackMessage& track : message.tracks) {
    recorded.tracks.push_back({readState("track", track, ids), track.moving != 0});
  }
  return recorded;
}

RecordedObjects toRecorded(const TrueObjectArray& message) {
  RecordedObjects recorded{toStamp(message.header.stamp), {}};
  std::set<std::uint32_t> ids;
  for (const TrueObject& object : message.objects) {
    recorded.objects.push_back({readState("object", object, ids), object.label, object.moving != 0,
                                object.visible_to, object.lidar_beams});
  }
  return recorded;
}

RecordedDetections toRecorded(const ObjectArray& message) {
  RecordedDetections recorded{toStamp(message.header.stamp), {}};
  for (const ObjectMessage& object : message.objects) {
    if (object.dynamic_state == ObjectMessage::STATE_MOVING) {
      recorded.moving.emplace_back(object.pose.position.x, object.pose.position.y);
      checkFinite("position of an object", recorded.moving.back());
    }
  }
  return recorded;
}

StampedPose toRecorded(const geometry_msgs::PoseWithCovarianceStamped& message) {
  const StampedPose recorded{toStamp(message.header.stamp),
                             {fromMessage(message.pose.pose), planarCovariance(message.pose)}};
  checkCovariance(recorded.pose.covariance);
  return recorded;
}

StampedPose toRecorded(const nav_msgs::Odometry& message) {
  return {toStamp(message.header.stamp), {fromMessage(message.pose.pose), {}}};
}

RecordedIntersection toRecorded(const datmo_fusion::RoadBorders& message) {
  return {toStamp(message.header.stamp), message.at_intersection != 0};
}

RecordedIntersection toRecorded(const TrueRoadBorders& message) {
  return {toStamp(message.header.stamp), message.at_intersection != 0};
}

}  // namespace datmo::evaluation
