// SPDX-License-Identifier: BSD-3-Clause
#include <memory>
#include <string>
#include <vector>

#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

#include "datmo_fusion/ros/display/grid_views.h"
#include "datmo_fusion/ros/parameters.h"
#include "datmo_fusion/ros/stage/guard.h"
#include "datmo_fusion/ros/subscription.h"

namespace datmo {

/// ROS interface of GridViews. In: grids/<panel> of each panel, map, pose. Out: grid_views. It
/// draws only for subscribers, and only when there is new input.
class GridViewsNodelet : public nodelet::Nodelet {
 private:
  void onInit() override {
    const auto options = loadOptions<GridViewsOptions>(getPrivateNodeHandle());
    monitor_ = std::make_unique<StageMonitor>(getName());
    views_ = std::make_unique<GridViews>(options);
    ros::NodeHandle& node = getNodeHandle();
    picture_ = node.advertise<sensor_msgs::Image>("grid_views", 1);
    for (const std::string& panel : views_->panels()) {
      grids_.push_back(Subscription::to<nav_msgs::OccupancyGrid>(
          node, topicOf(panel), 1, *monitor_,
          [this, panel](const nav_msgs::OccupancyGridConstPtr& grid) {
            views_->handleGrid(panel, grid);
            news_ = true;
          }));
    }
    pose_ = Subscription::to(node, "pose", 1, *monitor_, &GridViewsNodelet::handlePose, this);
    timer_ = node.createTimer(ros::Duration(1.0 / options.rate),
                              [this](const ros::TimerEvent& /*event*/) { draw(); });
  }

  static std::string topicOf(const std::string& panel) {
    return panel == "map" ? panel : "grids/" + panel;
  }

  void handlePose(const geometry_msgs::PoseWithCovarianceStampedConstPtr& message) {
    views_->handlePose(message);
  }

  void draw() {
    if (news_ && picture_.getNumSubscribers() > 0) {
      news_ = false;
      guarded(*monitor_, "timer", [this] { picture_.publish(views_->draw()); });
    }
  }

  std::unique_ptr<StageMonitor> monitor_;
  std::unique_ptr<GridViews> views_;
  bool news_ = false;  ///< a grid was received since the last picture
  ros::Publisher picture_;
  std::vector<Subscription> grids_;
  Subscription pose_;
  ros::Timer timer_;
};

}  // namespace datmo

PLUGINLIB_EXPORT_CLASS(datmo::GridViewsNodelet, nodelet::Nodelet)
