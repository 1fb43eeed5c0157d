// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <sensor_msgs/NavSatFix.h>

#include "datmo_fusion/fusion/earth/earth_frame_filter.h"
#include "datmo_fusion/ros/convert/earth_conversion.h"
#include "datmo_fusion/ros/frame_options.h"
#include "datmo_fusion/ros/stage/stage.h"
#include "datmo_fusion/ros/stage/stage_runner.h"
#include "datmo_fusion/ros/transform_buffer.h"

namespace datmo {

struct EarthFrameStageOptions {
  FrameOptions frames;  ///< shared by all stages
  StreamOptions input;
  double fix_sigma = 5.0;  ///< m
  double max_gap = 0.5;    ///< s
  EarthFrameOptions filter;

  void visit(OptionVisitor& visitor);
};

/// Runs EarthFrameFilter on messages: estimates the map's pose on the earth from a satellite
/// receiver's positions and the poses in the map. The first position is the datum of the plane. A
/// position waits for the pose after it, so that its own pose can be interpolated; a bad one is
/// dropped and reported to the monitor.
class EarthFrameStage : public Stage {
 public:
  using Options = EarthFrameStageOptions;

  /// `transforms` and `monitor` must outlive the stage. Throws OptionError.
  EarthFrameStage(const Checked<EarthFrameStageOptions>& options, const TransformBuffer& transforms,
                  StageMonitor& monitor);

  void handleFix(const sensor_msgs::NavSatFix& message);

  /// Returns the frame from the last position before the pose, with the pose's stamp and the
  /// covariance increased by the drive to the pose; null if unknown.
  EarthFrameMessagePtr handlePose(const geometry_msgs::PoseWithCovarianceStamped& message);

  void connect(StagePorts& ports) override;

 private:
  struct StampedPose {
    Stamp stamp;
    PoseWithCovariance pose;
  };

  void report();
  void reset();

  EarthFrameStageOptions options_;
  const TransformBuffer& transforms_;
  StageMonitor& monitor_;
  StageRunner runner_;
  EarthFrameFilter filter_;
  std::optional<LocalPlane> plane_;
  std::optional<StampedPose> last_pose_;
  std::deque<EarthFix> waiting_;
  Stamp last_fix_;
  std::uint64_t gated_ = 0;  ///< reported so far
};

}  // namespace datmo
