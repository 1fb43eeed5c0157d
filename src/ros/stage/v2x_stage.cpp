// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/v2x_stage.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <boost/make_shared.hpp>

#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/tracking/track_check.h"

namespace datmo {

namespace {

/// Averaging period of the own velocity from poses, s: shorter ones are noisy.
constexpr double kVelocityTime = 0.3;

/// Maximum time between the last own pose and another stamp that it is used for, s.
constexpr double kMaxPoseAge = 1.0;

/// Variances of our own speed and acceleration, as sent to others, (m/s)^2 and (m/s^2)^2.
constexpr double kOwnVelocityVariance = 0.04;
constexpr double kOwnAccelerationVariance = 4.0;

}  // namespace

void V2xStageOptions::visit(OptionVisitor& visitor) {
  visitor.integer({"station", "", "our station number, unique among all stations"}, station,
                  {0.0, 2147483647.0});
  visitor.number({"max_frame_age", "s",
                  "if the receiver's last position is older, no tracks are received or sent"},
                 max_frame_age, {0.1, 600.0});
  visitor.number({"own_clock_sigma", "s", "standard deviation of our stamps, for other stations"},
                 own_clock_sigma, {0.0, 10.0});
  visitor.group("input", [&] { input.visit(visitor); });
  visitor.group("tracks", [&] { tracks.visit(visitor); });
  visitor.group("vehicle", [&] { vehicle.visit(visitor); });
}

SharedKeys V2xStageOptions::sharedKeys() {
  return SharedKeys().group<HostVehicleOptions>("vehicle/", "vehicle/");
}

V2xStage::V2xStage(const Checked<V2xStageOptions>& options, StageMonitor& monitor)
    : options_(*options),
      monitor_(monitor),
      runner_(monitor, options->input, "forgets all stations", [this] { reset(); }),
      stations_(options->tracks) {}

void V2xStage::reset() {
  stations_.reset();
  frame_.reset();
  last_stamp_.reset();
  poses_.clear();
}

void V2xStage::handleFrame(const EarthFrameMessage& message) {
  runner_.serve([&] {
    EarthFrame frame = fromMessage(message);
    // From the same position as the last one: only its covariance is newer.
    if (!frame_ || frame.stamp != frame_->stamp) {
      runner_.check("earth_frame", message.header.stamp);
    }
    frame_ = frame;
  });
}

void V2xStage::handlePose(const geometry_msgs::PoseWithCovarianceStamped& message) {
  runner_.serve([&] {
    runner_.check("pose/local", message.header.stamp);
    poses_.push_back({toStamp(message.header.stamp), fromMessage(message.pose)});
    while (secondsBetween(poses_.front().stamp, poses_.back().stamp) > kMaxPoseAge) {
      poses_.pop_front();
    }
  });
}

const EarthFrame& V2xStage::frameAt(Stamp stamp) {
  if (!frame_ || std::abs(secondsBetween(frame_->stamp, stamp)) > options_.max_frame_age) {
    const std::string why = frame_ ? "the receiver's last position is older than max_frame_age"
                                   : "the map's pose on the earth is not known yet";
    monitor_.condition(HealthLevel::kDegraded, "no tracks are received or sent: " + why);
    throw InputError("no_earth_frame",
                     why + ": expected earth_frame, which needs gnss and a drive");
  }
  monitor_.condition(HealthLevel::kOk, "the map's pose on the earth is known");
  return *frame_;
}

void V2xStage::check(const StationTracksMessage& message, Stamp now) const {
  const double age = secondsBetween(toStamp(message.header.stamp), now);
  const std::string who = "station " + std::to_string(message.station);
  if (message.station == static_cast<std::uint32_t>(options_.station)) {
    throw InputError("own_number", who + " is our own number: expected another one in 'station'");
  }
  if (age > options_.tracks.max_age) {
    throw InputError("old_list", who + ": tracks " + std::to_string(age) +
                                     " s old, expected tracks/max_age at most");
  }
  if (age < -options_.tracks.max_ahead) {
    throw InputError("future_list", who + ": tracks of " + std::to_string(-age) +
                                        " s ahead, expected synchronized clocks");
  }
}

TrackArrayPtr V2xStage::handleStation(const StationTracksMessage& message, Stamp now) {
  return runner_.serve([&]() -> TrackArrayPtr {
    check(message, now);
    const EarthFrame& frame = frameAt(toStamp(message.header.stamp));
    const StationTrackList list = fromMessage(message, frame.plane);
    if (!stations_.isNew(list)) {
      throw InputError("repeated_list", "station " + std::to_string(message.station) +
                                            ": tracks that are not newer than its last ones");
    }
    monitor_.noteInput(list.stamp);
    stations_.toMap(list, frame.map_in_plane, ownAt(list.stamp));
    report();
    runner_.processed(list.stamp);
    if (last_stamp_ && list.stamp <= *last_stamp_) {
      return nullptr;  // it is sent with the next one
    }
    last_stamp_ = list.stamp;
    return boost::make_shared<TrackArray>(
        toMessage(stations_.merged(list.stamp), options_.frames.map));
  });
}

std::optional<OwnVehicle> V2xStage::ownAt(Stamp stamp) const {
  if (poses_.empty() || std::abs(secondsBetween(poses_.back().stamp, stamp)) > kMaxPoseAge) {
    return std::nullopt;
  }
  const StampedPose& last = poses_.back();
  OwnVehicle own;
  for (const StampedPose& earlier : poses_) {
    const double seconds = secondsBetween(earlier.stamp, last.stamp);
    if (seconds >= kVelocityTime) {  // the last one that is: the shortest sufficient time
      own.velocity = (last.pose.pose.position() - earlier.pose.pose.position()) / seconds;
    }
  }
  const Pose2 middle = last.pose.pose * Pose2(options_.vehicle.middleAhead(), 0.0, 0.0);
  own.box = {
      Pose2(middle.position() + secondsBetween(last.stamp, stamp) * own.velocity, middle.heading()),
      options_.vehicle.length, options_.vehicle.width};
  own.covariance = last.pose.covariance.topLeftCorner<2, 2>();
  return own;
}

StationTracksMessagePtr V2xStage::handleTracks(const TrackArray& message) {
  return runner_.serve([&]() -> StationTracksMessagePtr {
    runner_.check("tracks/own", message.header.stamp);
    const TrackList tracks = fromMessage(message);
    const EarthFrame& frame = frameAt(tracks.stamp);
    StationTrackList list;
    list.stamp = tracks.stamp;
    list.station = static_cast<std::uint32_t>(options_.station);
    list.clock_sigma = options_.own_clock_sigma;
    if (const std::optional<OwnVehicle> own = ownAt(list.stamp)) {
      Track self;  // id 0
      self.state << own->box.center.position(), own->velocity, Point2::Zero();
      self.covariance.diagonal() << 0.0, 0.0, kOwnVelocityVariance, kOwnVelocityVariance,
          kOwnAccelerationVariance, kOwnAccelerationVariance;
      self.covariance.topLeftCorner<2, 2>() = own->covariance;
      self.box = own->box;
      self.heading_variance = poses_.back().pose.covariance(2, 2);
      self.moving = true;
      self.class_probabilities[static_cast<std::size_t>(ObjectClass::kVehicle)] = 1.0;
      self.existence_probability = 1.0;
      list.tracks.push_back(toStation(self, frame.map_in_plane));
    }
    std::uint64_t invalid = 0;
    for (const Track& track : tracks.tracks) {
      if (isValid(track)) {
        list.tracks.push_back(toStation(track, frame.map_in_plane));
      } else {
        ++invalid;
      }
    }
    if (invalid > 0) {
      monitor_.warned({"bad_own_track", std::to_string(invalid) +
                                            " of our tracks have invalid numbers or an invalid "
                                            "covariance: they are not sent to other stations"});
    }
    return boost::make_shared<StationTracksMessage>(toMessage(list, frame.plane));
  });
}

void V2xStage::warn(std::uint64_t count, std::uint64_t& reported, const char* reason,
                    const char* text) {
  if (count > reported) {
    reported = count;
    monitor_.warned({reason, std::string("tracks of stations ") + text + ": left out"});
  }
}

void V2xStage::report() {
  const StationTrackCounts& counts = stations_.counts();
  warn(counts.fast, reported_.fast, "fast_track", "faster than tracks/max_speed");
  warn(counts.jumped, reported_.jumped, "jumped_track",
       "that jumped from their predicted position");
  warn(counts.sudden, reported_.sudden, "sudden_track",
       "with new ids in nearly every message, where there was no track");
  warn(counts.invalid, reported_.invalid, "bad_track",
       "with invalid numbers or an invalid covariance");
  warn(counts.many, reported_.many, "many_tracks", "beyond tracks/max_tracks");
  monitor_.figure("our own vehicle, as others see it", static_cast<double>(counts.own));
  monitor_.figure("tracks left out: too fast", static_cast<double>(counts.fast));
  monitor_.figure("tracks left out: jumped", static_cast<double>(counts.jumped));
  monitor_.figure("tracks left out: new ids", static_cast<double>(counts.sudden));
}

void V2xStage::connect(StagePorts& ports) {
  const auto foreign = ports.out<TrackArray>("tracks/v2x");
  const auto ours = ports.out<StationTracksMessage>("stations/own");
  ports.in<EarthFrameMessage>("earth_frame",
                              [this](const auto& frame, Stamp /*now*/) { handleFrame(*frame); });
  ports.in<geometry_msgs::PoseWithCovarianceStamped>(
      "pose/local", [this](const auto& pose, Stamp /*now*/) { handlePose(*pose); });
  ports.optionalIn<StationTracksMessage>("stations",
                                         [this, foreign](const auto& tracks, Stamp now) {
                                           foreign.publish(handleStation(*tracks, now));
                                         });
  ports.in<TrackArray>("tracks/own", [this, ours](const auto& tracks, Stamp /*now*/) {
    ours.publish(handleTracks(*tracks));
  });
}

}  // namespace datmo
