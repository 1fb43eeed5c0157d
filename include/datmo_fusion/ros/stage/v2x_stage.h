// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include <geometry_msgs/PoseWithCovarianceStamped.h>

#include "datmo_fusion/fusion/earth/station_tracks.h"
#include "datmo_fusion/risk/host_motion.h"
#include "datmo_fusion/ros/convert/earth_conversion.h"
#include "datmo_fusion/ros/convert/messages.h"
#include "datmo_fusion/ros/frame_options.h"
#include "datmo_fusion/ros/shared_keys.h"
#include "datmo_fusion/ros/stage/stage.h"
#include "datmo_fusion/ros/stage/stage_runner.h"

namespace datmo {

struct V2xStageOptions {
  FrameOptions frames;  ///< of all stages
  StreamOptions input;
  int station = 1;
  double max_frame_age = 5.0;     ///< s
  double own_clock_sigma = 0.02;  ///< s
  StationTrackOptions tracks;
  HostVehicleOptions vehicle;  ///< of all stages

  void visit(OptionVisitor& visitor);
  static SharedKeys sharedKeys();
};

/// StationTracks between messages: what other stations track, as one more source of track_fusion,
/// and what our own sensors track, for others. Lists that are old, repeated or of a clock that is
/// wrong are dropped, and nothing passes in or out where the map's pose on the earth is not known.
///
/// Stations send each at its own times: each list that is the newest makes one of all of them.
///
/// Ours go out without what other stations said: it would come back to them as a second opinion.
class V2xStage : public Stage {
 public:
  using Options = V2xStageOptions;

  /// `monitor` must outlive the stage. Throws OptionError.
  V2xStage(const Checked<V2xStageOptions>& options, StageMonitor& monitor);

  void takeFrame(const EarthFrameMessage& message);
  void takePose(const geometry_msgs::PoseWithCovarianceStamped& message);

  /// Null if the list was dropped. `now`: ROS time.
  TrackArrayPtr takeStation(const StationTracksMessage& message, Stamp now);

  /// Our sensors' tracks, as others take them.
  StationTracksMessagePtr takeTracks(const TrackArray& message);

  void connect(StagePorts& ports) override;

 private:
  struct StampedPose {
    Stamp stamp;
    PoseWithCovariance pose;
  };

  /// Throws InputError (`no_earth_frame`).
  const EarthFrame& frameAt(Stamp stamp);
  void check(const StationTracksMessage& message, Stamp now) const;
  std::optional<OwnVehicle> ownAt(Stamp stamp) const;
  void report();
  void warn(std::uint64_t count, std::uint64_t& reported, const char* reason, const char* text);
  void reset();

  V2xStageOptions options_;
  StageMonitor& monitor_;
  StageRunner runner_;
  StationTracks stations_;
  std::optional<EarthFrame> frame_;
  std::deque<StampedPose> poses_;    ///< of the last second
  std::optional<Stamp> last_stamp_;  ///< that was published
  StationTrackCounts reported_;
};

}  // namespace datmo
