#include <memory>
#include <string>

#include "source_fusion_nodelet.h"
#include <datmo_fusion/GridFusionConfig.h>
#include <dynamic_reconfigure/server.h>

#include <pluginlib/class_list_macros.hpp>

#include "datmo_fusion/ros/grid_fusion_stage.h"

namespace datmo {

/// The door to GridFusionStage. In: grids/<source> of each source, odometry or else pose. Out:
/// grids/fused, grids/conflict. The rule of fusion may be changed by dynamic_reconfigure.
class GridFusionNodelet
    : public SourceFusionNodelet<GridFusionStage, GridFusionStageOptions, nav_msgs::OccupancyGrid> {
 public:
  GridFusionNodelet() : SourceFusionNodelet("grids") {}

 private:
  using Config = datmo_fusion::GridFusionConfig;

  void prepare(const GridFusionStageOptions& options) override {
    rule_ = options.fuser.rule;
    fused_ = getNodeHandle().advertise<nav_msgs::OccupancyGrid>("grids/fused", kQueue);
    conflict_ = getNodeHandle().advertise<nav_msgs::OccupancyGrid>("grids/conflict", kQueue);
    reconfigure_ = std::make_unique<dynamic_reconfigure::Server<Config>>(getPrivateNodeHandle());
    reconfigure_->setCallback([this](Config& config, std::uint32_t /*level*/) { setRule(config); });
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

  void setRule(Config& config) {
    try {
      stage().setRule(config.rule);
      rule_ = config.rule;
    } catch (const OptionError& error) {
      NODELET_ERROR("%s; goes on with %s", error.what(), rule_.c_str());
      config.rule = rule_;
    }
  }

  std::unique_ptr<dynamic_reconfigure::Server<Config>> reconfigure_;
  std::string rule_;  ///< by its name
  ros::Publisher fused_;
  ros::Publisher conflict_;
};

}  // namespace datmo

PLUGINLIB_EXPORT_CLASS(datmo::GridFusionNodelet, nodelet::Nodelet)
