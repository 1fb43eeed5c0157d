// SPDX-License-Identifier: BSD-3-Clause
// The stages of a 3D lidar as nodelets: a library of their own, for nothing else links PCL.
#include "stage_nodelet.h"

#include <pluginlib/class_list_macros.hpp>

#include "datmo_fusion/ros/stage/cloud_objects_stage.h"
#include "datmo_fusion/ros/stage/cloud_to_scan_stage.h"

namespace datmo {

using CloudObjectsNodelet = StageNodelet<CloudObjectsStage>;
using CloudToScanNodelet = StageNodelet<CloudToScanStage>;

}  // namespace datmo

PLUGINLIB_EXPORT_CLASS(datmo::CloudObjectsNodelet, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(datmo::CloudToScanNodelet, nodelet::Nodelet)
