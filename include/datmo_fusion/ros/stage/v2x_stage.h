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
  FrameOptions frames;  ///< shared by all stages
  StreamOptions input;
  int station = 1;
  double max_frame_age = 5.0;     ///< s
  double own_clock_sigma = 0.02;  ///< s
  StationTrackOptions tracks;
  HostVehicleOptions vehicle;  ///< shared by all stages

  void visit(OptionVisitor& visitor);
  static SharedKeys sharedKeys();
};

/// Runs StationTracks on messages: tracks of other stations as one more source for track_fusion,
/// and our own sensors' tracks for others. Lists that are old, repeated or have a wrong clock are
/// dropped, and nothing is received or sent while the map's pose on the earth is unknown.
///
/// Stations send asynchronously: each new list triggers an output that merges those of all
/// stations.
///
/// Our tracks are sent without those of other stations, to whom they would return as a second
/// opinion.
class V2xStage : public Stage {
 public:
  using Options = V2xStageOptions;

  /// `monitor` must outlive the stage. Throws OptionError.
  V2xStage(const Checked<V2xStageOptions>& options, StageMonitor& monitor);

  void handleFrame(const EarthFrameMessage& message);
  void handlePose(const geometry_msgs::PoseWithCovarianceStamped& message);

  /// Null if the list was dropped. `now`: ROS time.
  TrackArrayPtr handleStation(const StationTracksMessage& message, Stamp now);

  /// Returns our sensors' tracks, in the form that other stations use.
  StationTracksMessagePtr handleTracks(const TrackArray& message);

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
  std::optional<Stamp> last_stamp_;  ///< last published stamp
  StationTrackCounts reported_;
};

}  // namespace datmo
