// SPDX-License-Identifier: BSD-3-Clause
// The stages of the stereo camera as nodelets.
#include "stage_nodelet.h"

#include <pluginlib/class_list_macros.hpp>

#include "datmo_fusion/ros/stage/point_velocity_stage.h"
#include "datmo_fusion/ros/stage/stereo_alignment_stage.h"
#include "datmo_fusion/ros/stage/stereo_grid_stage.h"
#include "datmo_fusion/ros/stage/stereo_objects_stage.h"

namespace datmo {

using PointVelocityNodelet = StageNodelet<PointVelocityStage>;
using StereoAlignmentNodelet = StageNodelet<StereoAlignmentStage>;
using StereoGridNodelet = StageNodelet<StereoGridStage>;
using StereoObjectsNodelet = StageNodelet<StereoObjectsStage>;

}  // namespace datmo

PLUGINLIB_EXPORT_CLASS(datmo::PointVelocityNodelet, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(datmo::StereoAlignmentNodelet, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(datmo::StereoGridNodelet, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(datmo::StereoObjectsNodelet, nodelet::Nodelet)
