#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "low_level_pipeline.h"
#include "object_fusion_pipeline.h"
#include "pipeline_options.h"
#include "stage_times.h"
#include "stereo_images.h"
#include "track_fusion_pipeline.h"
#include "wiring.h"
#include <tf2_msgs/TFMessage.h>

#include "datmo_fusion/ros/cloud_to_scan_stage.h"
#include "datmo_fusion/ros/motion_stage.h"
#include "datmo_fusion/ros/stage_monitor.h"
#include "datmo_fusion/ros/transform_buffer.h"

namespace datmo {

/// The stages of perception.launch, wired without a master:
///
///     scan, odometry, tf ─► grid_slam ─ split scan ─► moving_objects ─ objects ─► tracker ─ tracks
///                               └───────── split scan, map -> odom ──────────────────┘
///
/// with the clouds of a 3D lidar in place of scans
///
///     cloud, tf ──► cloud_to_scan ─ scan
///
/// with a motion that other sensors tell, motion before it,
///
///     imu, twist, joint_states, tf ──► motion ─ odometry
///
/// with road borders those of each split scan before moving_objects, which then takes them,
///
///     split scan ──► road_border ─ borders
///
/// with low-level fusion LowLevelPipeline before grid_slam, which then waits for its grids, with
/// object-level fusion ObjectFusionPipeline before the tracker, which then takes its objects, and
/// with track-level fusion TrackFusionPipeline after it. They share the stereo camera's clouds,
/// which are made here where there are images alone, and the last two its objects:
///
///     points2, right camera_info, tf ──► stereo_objects ─ objects of stereo
///
/// Messages go in one after the other, as they came; the same messages give the same results, bit
/// for bit. `now` is the time at which a message came.
class Pipeline {
 public:
  /// Throws OptionError.
  explicit Pipeline(const PipelineOptions& options, const Wiring& wiring = {});

  /// What one message led to, each in the order in which it came to be.
  struct Output {
    std::vector<LowLevelPipeline::NamedGrid> grids;
    std::vector<CloudToScanOutput> cloud_scans;  ///< made of clouds
    std::vector<GridSlamOutput> slam;
    std::vector<RoadBordersPtr> borders;
    std::vector<DroppedObjectsPtr> dropped;  ///< at the borders
    std::vector<ObjectFusionPipeline::NamedObjects> objects;
    std::vector<TrackFusionPipeline::NamedTracks> source_tracks;  ///< that are fused
    std::vector<TrackArrayPtr> tracks;                            ///< of the last stage
    std::vector<nav_msgs::OccupancyGridPtr> maps;
  };

  void takeStaticTransforms(const tf2_msgs::TFMessage& message);

  /// Objects may have waited for a transform, so that there may be tracks. What grid_slam
  /// publishes itself is left out: a bag of an earlier run may hold it.
  Output takeTransforms(const tf2_msgs::TFMessage& message, Stamp now);

  Output takeOdometry(const nav_msgs::Odometry& message, Stamp now);

  /// Of what tells the motion in place of odometry; read where the options say so.
  Output takeImu(const sensor_msgs::Imu& message, Stamp now);
  /// `Message`: geometry_msgs::TwistStamped or TwistWithCovarianceStamped.
  template <typename Message>
  Output takeTwist(const Message& message, Stamp now) {
    return followMotion(motion_.takeTwist(message), now);
  }
  Output takeWheels(const sensor_msgs::JointState& message, Stamp now);

  /// `Message`: sensor_msgs::LaserScan or MultiEchoLaserScan.
  template <typename Message>
  Output takeScan(const Message& message, Stamp now) {
    Output output;
    feedScan(message, now, output);
    return output;
  }

  /// Of a 3D lidar, read where scans come from it.
  Output takeLidarCloud(const sensor_msgs::PointCloud2& message, Stamp now);

  /// The stereo camera's messages, read with fusion alone; images where points come from them.
  Output takeCloud(const sensor_msgs::PointCloud2& message, Stamp now);
  Output takeImage(StereoSide side, const sensor_msgs::ImageConstPtr& image, Stamp now);
  Output takeCameraInfo(StereoSide side, const sensor_msgs::CameraInfoConstPtr& info, Stamp now);

  /// Of sources that have no stage here; read with fusion of their level alone.
  Output takeGrid(const std::string& source, const nav_msgs::OccupancyGrid& grid, Stamp now);
  Output takeObjects(const std::string& source, const ObjectArrayConstPtr& objects, Stamp now);
  Output takeTracks(const std::string& source, const TrackArray& tracks, Stamp now);

  /// What is left when the last message came at `now`.
  Output finish(Stamp now);

  const StageTimes& times() const { return times_; }
  std::vector<const StageMonitor*> monitors() const;

  /// Those of them that drop a message when it comes, if at all; the tracker does it when it has
  /// waited for too long.
  std::vector<const StageMonitor*> doors() const;

  /// Of what is wrong with messages before a stage has them.
  StageMonitor& inputs() { return inputs_monitor_; }
  const StageMonitor& inputs() const { return inputs_monitor_; }

 private:
  template <typename Message>
  void feedScan(const Message& message, Stamp now, Output& output) {
    if (last_ != LastStage::kGridFusion) {
      if (auto slam = slam_.takeScan(message)) {
        followSlam(std::move(*slam), now, output);
      }
    }
    if (low_level_) {
      low_level_->takeScan(message, now, output.grids);
    }
    followFusion(now, output);
  }

  bool reaches(LastStage stage) const { return last_ >= stage; }
  /// Odometry made of other sensors (null: there is none) goes the way of the vehicle's own.
  Output followMotion(const nav_msgs::OdometryPtr& odometry, Stamp now);
  bool isFromSlam(const geometry_msgs::TransformStamped& transform) const;

  void feedCloud(const sensor_msgs::PointCloud2& cloud, Stamp now, Output& output);
  /// A cloud made of images; null: there is none.
  void feedMadeCloud(const sensor_msgs::PointCloud2Ptr& cloud, Stamp now, Output& output);
  /// To the levels that use them.
  void feedObjects(const std::string& source, const ObjectArrayConstPtr& objects, Stamp now);

  /// What is ready in the fusions goes on to the stages after them.
  void followFusion(Stamp now, Output& output);
  void followGrids(Stamp now, Output& output);
  void followObjects(Stamp now, Output& output);
  void followSlam(GridSlamOutput slam, Stamp now, Output& output);
  void detect(const GridSlamOutput& slam, Stamp now, Output& output);
  void findBorders(const SplitScanMessage& split_scan, Output& output);
  void followTracks(Stamp now, Output& output);
  void drainTracker(Stamp now, Output& output);
  void bookTime(const StageMonitor& monitor);

  PipelineOptions options_;
  LastStage last_;
  StageMonitor inputs_monitor_{"inputs"};
  TransformBuffer transforms_;
  StageMonitor motion_monitor_{"motion"};
  StageMonitor cloud_monitor_{"cloud_to_scan"};
  StageMonitor images_monitor_{"stereo_images"};
  StageMonitor slam_monitor_{"grid_slam"};
  StageMonitor road_border_monitor_{"road_border"};
  StageMonitor detector_monitor_{"moving_objects"};
  StageMonitor stereo_objects_monitor_{"stereo_objects"};
  StageMonitor tracker_monitor_{"tracker"};
  StageTimes times_;
  std::optional<CloudToScanStage> cloud_to_scan_;        ///< none if there are scans
  std::optional<StereoImages> images_;                   ///< none if there are clouds
  std::unique_ptr<LowLevelPipeline> low_level_;          ///< null without low-level fusion
  std::optional<StereoObjectsStage> stereo_objects_;     ///< none if no level uses them
  std::unique_ptr<ObjectFusionPipeline> object_fusion_;  ///< null without object-level fusion
  std::unique_ptr<TrackFusionPipeline> track_fusion_;    ///< null without track-level fusion
  MotionStage motion_;
  GridSlamStage slam_;
  std::optional<RoadBorderStage> road_border_;  ///< none without road borders
  MovingObjectsStage detector_;
  TrackerStage tracker_;
};

}  // namespace datmo
