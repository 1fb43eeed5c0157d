// SPDX-License-Identifier: BSD-3-Clause
// The stages that fuse several sources as nodelets.
#include "stage_nodelet.h"

#include <pluginlib/class_list_macros.hpp>

#include "datmo_fusion/ros/stage/grid_fusion_stage.h"
#include "datmo_fusion/ros/stage/object_fusion_stage.h"
#include "datmo_fusion/ros/stage/track_fusion_stage.h"

namespace datmo {

using ObjectFusionNodelet = StageNodelet<ObjectFusionStage>;
using GridFusionNodelet = StageNodelet<GridFusionStage>;
using TrackFusionNodelet = StageNodelet<TrackFusionStage>;

}  // namespace datmo

PLUGINLIB_EXPORT_CLASS(datmo::GridFusionNodelet, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(datmo::ObjectFusionNodelet, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(datmo::TrackFusionNodelet, nodelet::Nodelet)
