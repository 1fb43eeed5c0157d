// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/LaserScan.h>

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/fusion/sync/source_matcher.h"
#include "datmo_fusion/ros/convert/scan_conversion.h"
#include "datmo_fusion/ros/frame_options.h"
#include "datmo_fusion/ros/motion_options.h"
#include "datmo_fusion/ros/shared_keys.h"
#include "datmo_fusion/ros/stage/frozen_sensor.h"
#include "datmo_fusion/ros/stage/fusion_inputs.h"
#include "datmo_fusion/ros/stage/stage.h"
#include "datmo_fusion/ros/stage/stage_runner.h"
#include "datmo_fusion/ros/transform_buffer.h"
#include "datmo_fusion/sensor_model/scan_merger.h"

namespace datmo {

/// One of the scanners.
struct MergedScannerOptions {
  bool use = true;
  std::vector<double> blind_sectors;  ///< rad, pairs

  void visit(OptionVisitor& visitor);
};

struct ScanMergeStageOptions {
  FrameOptions frames;             ///< shared by all stages
  MotionOptions motion;            ///< shared by all stages
  double max_tilt = degrees(5.0);  ///< rad
  std::string scan_frame = "merged_scan";
  StreamOptions input;
  SourceMatcherOptions matcher{"front", 0.06, 0.06, 0.5};
  ScanConversionOptions scan;
  ScanMergerOptions merger;
  std::map<std::string, MergedScannerOptions> sources{{"front", {}}, {"rear", {}}};

  std::vector<std::string> sourcesInUse() const;
  void visit(OptionVisitor& visitor);
  void check() const;
  static SharedKeys sharedKeys();
};

/// Merges the scans of several scanners into one, of a virtual scanner at the vehicle's origin, at
/// the reference's stamp: each beam is moved there by the vehicle's motion since it was measured.
/// FusionInputs decides what is accepted and reports missing scanners; merging continues with the
/// others. A frozen scanner is left out, too.
class ScanMergeStage : public Stage {
 public:
  using Options = ScanMergeStageOptions;

  /// `transforms` and `monitor` must outlive the stage. Throws OptionError.
  ScanMergeStage(const Checked<ScanMergeStageOptions>& options, const TransformBuffer& transforms,
                 StageMonitor& monitor);

  /// Sets the newest odometry; ignored if the options say that the vehicle has none.
  void handleOdometry(const nav_msgs::Odometry& message) { inputs_.handleMotion(message); }

  /// Sets the newest SLAM pose; used only if the options say that the vehicle has no odometry.
  void handlePose(const geometry_msgs::PoseWithCovarianceStamped& message) {
    inputs_.handleMotion(message);
  }

  /// Adds a scan of one scanner. `now`: ROS time.
  void handleScan(const std::string& source, const sensor_msgs::LaserScan& message, Stamp now);

  /// Returns the next set of scans that is ready, merged; null if there is none. `now`: ROS time.
  sensor_msgs::LaserScanPtr next(Stamp now);

  /// Returns base -> the merged scan's frame, at the height of the reference's scanner, if it has
  /// changed since it was last returned.
  std::optional<geometry_msgs::TransformStamped> takeMount();

  void connect(StagePorts& ports) override;
  bool publishNext(Stamp now) override;
  double maxWait() const override { return options_.matcher.max_wait; }

 private:
  using Matched = MatchedSamples<Scan>;

  void reset();
  void checkFrozen(const std::string& source, const sensor_msgs::LaserScan& message);
  /// The scans of the set as measured at its stamp; those with unknown motion are added to
  /// `missing`.
  std::vector<Scan> movedScans(const Matched& matched, std::vector<MissingSource>& missing) const;
  Scan compensated(const Scan& scan) const;
  sensor_msgs::LaserScanPtr merge(const Matched& matched);

  ScanMergeStageOptions options_;
  const TransformBuffer& transforms_;
  StageMonitor& monitor_;
  StageRunner runner_;
  FusionInputs inputs_;
  SourceMatcher<Scan> matcher_;
  ScanMerger merger_;
  std::map<std::string, FrozenSensor> frozen_;  ///< by source
  double height_ = 0.0;                         ///< m, of the reference's scanner
  std::optional<double> published_height_;      ///< m
  StagePublisher<sensor_msgs::LaserScan> scans_;
  StagePublisher<tf2_msgs::TFMessage> mounts_;
};

}  // namespace datmo
