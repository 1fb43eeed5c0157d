// SPDX-License-Identifier: BSD-3-Clause
// The stages that fuse several sources as nodelets. What a person chooses among while looking at
// rviz, dynamic_reconfigure changes.
#include <memory>

#include "choice_server.h"
#include "stage_nodelet.h"
#include <datmo_fusion/GridFusionConfig.h>
#include <datmo_fusion/TrackFusionConfig.h>

#include <pluginlib/class_list_macros.hpp>

#include "datmo_fusion/ros/stage/grid_fusion_stage.h"
#include "datmo_fusion/ros/stage/object_fusion_stage.h"
#include "datmo_fusion/ros/stage/track_fusion_stage.h"

namespace datmo {

using ObjectFusionNodelet = StageNodelet<ObjectFusionStage>;

/// The rule of fusion may be changed.
class GridFusionNodelet : public StageNodelet<GridFusionStage> {
 private:
  using Config = datmo_fusion::GridFusionConfig;

  void prepare(GridFusionStage& stage, const GridFusionStageOptions& options) override {
    rule_ = std::make_unique<ChoiceServer<Config>>(
        getPrivateNodeHandle(), &Config::rule, options.fuser.rule,
        [&stage](const std::string& rule) { stage.setRule(rule); });
  }

  std::unique_ptr<ChoiceServer<Config>> rule_;
};

/// Which tracks come out may be changed.
class TrackFusionNodelet : public StageNodelet<TrackFusionStage> {
 private:
  using Config = datmo_fusion::TrackFusionConfig;

  void prepare(TrackFusionStage& stage, const TrackFusionStageOptions& options) override {
    scheme_ = std::make_unique<ChoiceServer<Config>>(
        getPrivateNodeHandle(), &Config::scheme, options.fuser.scheme,
        [&stage](const std::string& scheme) { stage.setScheme(scheme); });
  }

  std::unique_ptr<ChoiceServer<Config>> scheme_;
};

}  // namespace datmo

PLUGINLIB_EXPORT_CLASS(datmo::GridFusionNodelet, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(datmo::ObjectFusionNodelet, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(datmo::TrackFusionNodelet, nodelet::Nodelet)
