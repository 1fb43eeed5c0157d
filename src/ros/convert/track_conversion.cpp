// SPDX-License-Identifier: BSD-3-Clause
#include <cstddef>
#include <vector>

#include "message_parts.h"

#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/tracking/track_check.h"

namespace datmo {

namespace {

/// Row by row, the layout of messages.
using CovarianceMessage = Eigen::Matrix<double, kTrackState, kTrackState, Eigen::RowMajor>;

PathPointMessage toMessage(const PathPoint& point) {
  PathPointMessage message;
  message.stamp = toTime(point.stamp);
  message.pose = toPose2D(point.pose);
  return message;
}

PathPoint fromMessage(const PathPointMessage& message) {
  return {toStamp(message.stamp), toPose2(message.pose)};
}

SourceTrackMessage toMessage(const SourceTrack& source) {
  SourceTrackMessage message;
  message.source = source.source;
  message.id = source.id;
  return message;
}

SourceTrack fromMessage(const SourceTrackMessage& message) { return {message.source, message.id}; }

TrackMessage toMessage(const Track& track) {
  TrackMessage message;
  message.id = track.id;
  message.pose = toMessage(track.box.center);
  message.size = size(track.box, track.height);
  message.velocity = planar(track.state(2), track.state(3));
  message.acceleration = planar(track.state(4), track.state(5));
  message.yaw_rate = track.yaw_rate;
  Eigen::Map<CovarianceMessage>(message.covariance.data()) = track.covariance;
  message.moving = track.moving;
  message.heading_variance = track.heading_variance;
  message.mode_probabilities = toFloats(track.mode_probabilities);
  setClasses(track.class_probabilities, message);
  message.existence_probability = static_cast<float>(track.existence_probability);
  message.age = ros::Duration(track.age);
  message.since_update = ros::Duration(track.since_update);
  message.hits = track.hits;
  message.sensors = track.sensors;
  for (const PathPoint& point : track.history) {
    message.history.push_back(toMessage(point));
  }
  for (const SourceTrack& source : track.sources) {
    message.sources.push_back(toMessage(source));
  }
  return message;
}

Track fromMessage(const TrackMessage& message) {
  Track track;
  track.id = message.id;
  track.state << message.pose.position.x, message.pose.position.y, message.velocity.x,
      message.velocity.y, message.acceleration.x, message.acceleration.y;
  track.covariance = Eigen::Map<const CovarianceMessage>(message.covariance.data());
  track.mode_probabilities = fromFloats<kMotionModes>(message.mode_probabilities);
  track.box = {boxCenter(message.pose), message.size.x, message.size.y};
  track.height = message.size.z;
  track.yaw_rate = message.yaw_rate;
  track.heading_variance = message.heading_variance;
  track.moving = message.moving != 0;
  track.class_probabilities = fromFloats<kObjectClasses>(message.class_probabilities);
  track.existence_probability = message.existence_probability;
  track.age = message.age.toSec();
  track.since_update = message.since_update.toSec();
  track.hits = message.hits;
  track.sensors = message.sensors;
  for (const PathPointMessage& point : message.history) {
    track.history.push_back(fromMessage(point));
  }
  for (const SourceTrackMessage& source : message.sources) {
    track.sources.push_back(fromMessage(source));
  }
  return track;
}

ViewFanMessage toMessage(const ViewFan& fan) {
  ViewFanMessage message;
  message.sensor = toPose2D(fan.sensor);
  message.first_bearing = static_cast<float>(fan.first_bearing);
  message.beam_spacing = static_cast<float>(fan.beam_spacing);
  message.min_range = static_cast<float>(fan.min_range);
  message.sure_range = static_cast<float>(fan.sure_range);
  message.range = static_cast<float>(fan.range);
  message.by_beams = fan.by_beams;
  message.reach = toFloats(fan.reach);
  return message;
}

ViewFan fromMessage(const ViewFanMessage& message) {
  return {toPose2(message.sensor), message.first_bearing,
          message.beam_spacing,    message.min_range,
          message.sure_range,      message.range,
          message.by_beams != 0,   std::vector<double>(message.reach.begin(), message.reach.end())};
}

}  // namespace

TrackArray toMessage(const TrackList& list, const std::string& fixed_frame) {
  TrackArray message;
  message.header = header(list.stamp, fixed_frame);
  for (const Track& track : list.tracks) {
    message.tracks.push_back(toMessage(track));
  }
  for (const ViewFan& view : list.views) {
    message.views.push_back(toMessage(view));
  }
  return message;
}

TrackList fromMessage(const TrackArray& message) {
  TrackList list;
  list.stamp = toStamp(message.header.stamp);
  for (const TrackMessage& track : message.tracks) {
    list.tracks.push_back(fromMessage(track));
  }
  for (const ViewFanMessage& message_view : message.views) {
    const ViewFan view = fromMessage(message_view);
    if (isValid(view)) {
      list.views.push_back(view);
    }
  }
  return list;
}

}  // namespace datmo
