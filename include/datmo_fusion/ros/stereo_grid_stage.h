#pragma once

#include <optional>
#include <string>

#include <nav_msgs/OccupancyGrid.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/PointCloud2.h>

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/ros/stage_monitor.h"
#include "datmo_fusion/ros/stamp_check.h"
#include "datmo_fusion/ros/transform_buffer.h"
#include "datmo_fusion/sensor_model/stereo_grid.h"

namespace datmo {

/// What serves until a camera info has come, and what no message tells.
struct StereoCameraOptions {
  double focal_length = 0.0;             ///< px; 0: not known
  double baseline = 0.0;                 ///< m; 0: not known
  double field_of_view = degrees(60.0);  ///< rad
  double disparity_sigma = 0.25;         ///< px

  void visit(OptionVisitor& visitor);
};

struct StereoGridStageOptions {
  std::string base_frame = "base_link";
  std::string camera_frame;
  std::string scanner_frame = "scanner";
  double scanner_height = 0.33;  ///< m
  StereoCameraOptions camera;
  StreamOptions input;
  StereoGridOptions grid;

  void visit(OptionVisitor& visitor);
};

/// StereoGridModel between messages: the same one serves the nodelet and the bag runner. Bad input
/// is dropped or warned of through the monitor, never thrown. When the clock jumps back the road of
/// the last clouds is forgotten.
class StereoGridStage {
 public:
  /// `transforms` and `monitor` must outlive the stage. Throws OptionError.
  StereoGridStage(const StereoGridStageOptions& options, const TransformBuffer& transforms,
                  StageMonitor& monitor);

  /// Of the right camera; the newest one serves.
  void takeCameraInfo(const sensor_msgs::CameraInfo& message);

  /// Null if the cloud was dropped.
  nav_msgs::OccupancyGridPtr takeCloud(const sensor_msgs::PointCloud2& message);

 private:
  /// Throws InputError (`missing_camera_info`).
  StereoCamera camera() const;

  /// Throws InputError (`bad_camera`) for one that is not mounted as one that sees the road.
  StereoGridResult gridOf(const StereoCloud& cloud);

  /// Above base_link's origin, m.
  double scannerHeight();
  void show(const StereoGridResult& result);

  StereoGridStageOptions options_;
  const TransformBuffer& transforms_;
  StageMonitor& monitor_;
  StereoGridModel model_;
  StampCheck stamps_;
  std::optional<StereoCamera> camera_;  ///< as the last camera info says
};

}  // namespace datmo
