#include <memory>
#include <string>

#include "choice_server.h"
#include "moving_fusion_nodelet.h"
#include <datmo_fusion/GridFusionConfig.h>

#include <pluginlib/class_list_macros.hpp>

#include "datmo_fusion/ros/grid_fusion_stage.h"

namespace datmo {

/// The door to GridFusionStage. In: grids/<source> of each source, odometry or else pose. Out:
/// grids/fused, grids/conflict. The rule of fusion may be changed by dynamic_reconfigure.
class GridFusionNodelet
    : public MovingFusionNodelet<GridFusionStage, GridFusionStageOptions, nav_msgs::OccupancyGrid> {
 public:
  GridFusionNodelet() : MovingFusionNodelet("grids") {}

 private:
  using Config = datmo_fusion::GridFusionConfig;

  void prepare(const GridFusionStageOptions& options) override {
    fused_ = getNodeHandle().advertise<nav_msgs::OccupancyGrid>("grids/fused", kQueue);
    conflict_ = getNodeHandle().advertise<nav_msgs::OccupancyGrid>("grids/conflict", kQueue);
    rule_ = std::make_unique<ChoiceServer<Config>>(
        getPrivateNodeHandle(), &Config::rule, options.fuser.rule,
        [this](const std::string& rule) { stage().setRule(rule); });
  }

  void take(const std::string& source, const nav_msgs::OccupancyGrid& message, Stamp now) override {
    stage().takeGrid(source, message, now);
  }

  bool publishNext(Stamp now) override {
    const auto output = stage().next(now);
    if (output) {
      fused_.publish(output->fused);
      conflict_.publish(output->conflict);
    }
    return output.has_value();
  }

  std::unique_ptr<ChoiceServer<Config>> rule_;
  ros::Publisher fused_;
  ros::Publisher conflict_;
};

}  // namespace datmo

PLUGINLIB_EXPORT_CLASS(datmo::GridFusionNodelet, nodelet::Nodelet)
