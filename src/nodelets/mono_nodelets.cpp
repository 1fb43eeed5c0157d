// SPDX-License-Identifier: BSD-3-Clause
// The stages of a single camera as nodelets: a library of their own, for nothing else links
// OpenCV's detectors and networks.
#include "stage_nodelet.h"

#include <pluginlib/class_list_macros.hpp>

#include "datmo_fusion/ros/stage/mono_classifier_stage.h"
#include "datmo_fusion/ros/stage/mono_grid_stage.h"

namespace datmo {

using MonoClassifierNodelet = StageNodelet<MonoClassifierStage>;
using MonoGridNodelet = StageNodelet<MonoGridStage>;

}  // namespace datmo

PLUGINLIB_EXPORT_CLASS(datmo::MonoClassifierNodelet, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(datmo::MonoGridNodelet, nodelet::Nodelet)
