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
  FrameOptions frames;  ///< of all stages
  StreamOptions input;
  double fix_sigma = 5.0;  ///< m
  double max_gap = 0.5;    ///< s
  EarthFrameOptions filter;

  void visit(OptionVisitor& visitor);
};

/// EarthFrameFilter between messages: the positions of a satellite receiver and the poses in the
/// map make the map's pose on the earth. The first position is the datum of the plane. A position
/// waits for the pose after it, so that its own pose is interpolated; a bad one is dropped through
/// the monitor.
class EarthFrameStage : public Stage {
 public:
  using Options = EarthFrameStageOptions;

  /// `transforms` and `monitor` must outlive the stage. Throws OptionError.
  EarthFrameStage(const Checked<EarthFrameStageOptions>& options, const TransformBuffer& transforms,
                  StageMonitor& monitor);

  void takeFix(const sensor_msgs::NavSatFix& message);

  /// The frame by the last position before the pose, whose stamp it has, with the covariance that
  /// the drive to the pose has left of it; null if it is not known.
  EarthFrameMessagePtr takePose(const geometry_msgs::PoseWithCovarianceStamped& message);

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
