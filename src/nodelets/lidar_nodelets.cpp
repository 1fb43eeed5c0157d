// SPDX-License-Identifier: BSD-3-Clause
// The stages of the laser scanner and of a radar, from scans to objects, and the tracker, as
// nodelets.
#include "stage_nodelet.h"

#include <pluginlib/class_list_macros.hpp>

#include "datmo_fusion/ros/stage/grid_slam_stage.h"
#include "datmo_fusion/ros/stage/lidar_grid_stage.h"
#include "datmo_fusion/ros/stage/loop_closing_stage.h"
#include "datmo_fusion/ros/stage/motion_stage.h"
#include "datmo_fusion/ros/stage/moving_objects_stage.h"
#include "datmo_fusion/ros/stage/radar_objects_stage.h"
#include "datmo_fusion/ros/stage/road_border_stage.h"
#include "datmo_fusion/ros/stage/scan_merge_stage.h"
#include "datmo_fusion/ros/stage/static_points_stage.h"
#include "datmo_fusion/ros/stage/tracker_stage.h"

namespace datmo {

using GridSlamNodelet = StageNodelet<GridSlamStage>;
using LidarGridNodelet = StageNodelet<LidarGridStage>;
using LoopClosingNodelet = StageNodelet<LoopClosingStage>;
using MotionNodelet = StageNodelet<MotionStage>;
using MovingObjectsNodelet = StageNodelet<MovingObjectsStage>;
using RadarObjectsNodelet = StageNodelet<RadarObjectsStage>;
using RoadBorderNodelet = StageNodelet<RoadBorderStage>;
using ScanMergeNodelet = StageNodelet<ScanMergeStage>;
using StaticPointsNodelet = StageNodelet<StaticPointsStage>;
using TrackerNodelet = StageNodelet<TrackerStage>;

}  // namespace datmo

PLUGINLIB_EXPORT_CLASS(datmo::GridSlamNodelet, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(datmo::LidarGridNodelet, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(datmo::LoopClosingNodelet, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(datmo::MotionNodelet, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(datmo::MovingObjectsNodelet, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(datmo::RadarObjectsNodelet, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(datmo::RoadBorderNodelet, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(datmo::ScanMergeNodelet, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(datmo::StaticPointsNodelet, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(datmo::TrackerNodelet, nodelet::Nodelet)
