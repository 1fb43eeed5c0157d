// SPDX-License-Identifier: BSD-3-Clause
// The stages that fuse several sources, and what is made of all, as nodelets.
#include "stage_nodelet.h"

#include <pluginlib/class_list_macros.hpp>

#include "datmo_fusion/ros/stage/earth_frame_stage.h"
#include "datmo_fusion/ros/stage/grid_fusion_stage.h"
#include "datmo_fusion/ros/stage/map_fusion_stage.h"
#include "datmo_fusion/ros/stage/object_fusion_stage.h"
#include "datmo_fusion/ros/stage/risk_stage.h"
#include "datmo_fusion/ros/stage/track_fusion_stage.h"
#include "datmo_fusion/ros/stage/v2x_stage.h"

namespace datmo {

using EarthFrameNodelet = StageNodelet<EarthFrameStage>;
using V2xNodelet = StageNodelet<V2xStage>;
using ObjectFusionNodelet = StageNodelet<ObjectFusionStage>;
using GridFusionNodelet = StageNodelet<GridFusionStage>;
using MapFusionNodelet = StageNodelet<MapFusionStage>;
using RiskNodelet = StageNodelet<RiskStage>;
using TrackFusionNodelet = StageNodelet<TrackFusionStage>;

}  // namespace datmo

PLUGINLIB_EXPORT_CLASS(datmo::EarthFrameNodelet, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(datmo::V2xNodelet, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(datmo::GridFusionNodelet, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(datmo::MapFusionNodelet, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(datmo::ObjectFusionNodelet, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(datmo::RiskNodelet, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(datmo::TrackFusionNodelet, nodelet::Nodelet)
