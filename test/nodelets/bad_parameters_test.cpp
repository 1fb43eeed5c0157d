// SPDX-License-Identifier: BSD-3-Clause
// A nodelet with a bad parameter does not start, and reports why once; its manager and the other
// nodelets keep running.
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <nodelet/NodeletList.h>
#include <nodelet/NodeletLoad.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Log.h>

namespace datmo::bad_parameters_test {
namespace {

class BadParametersTest : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(ros::service::waitForService("/perception/list", ros::Duration(120.0)));
    log_ = node_.subscribe<rosgraph_msgs::Log>("/rosout", 1000,
                                               [this](const rosgraph_msgs::LogConstPtr& entry) {
                                                 if (entry->level >= rosgraph_msgs::Log::FATAL) {
                                                   fatal_.push_back(entry->msg);
                                                 }
                                               });
    ASSERT_TRUE(waitFor([this] { return log_.getNumPublishers() >= 2; })) << "test and manager";
  }

  bool waitFor(const std::function<bool()>& condition) {
    const ros::SteadyTime end = ros::SteadyTime::now() + ros::WallDuration(120.0);
    while (!condition()) {
      if (ros::SteadyTime::now() > end) {
        return false;
      }
      ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.01));
    }
    return true;
  }

  bool load(const std::string& name, const std::string& type) {
    nodelet::NodeletLoad load;
    load.request.name = name;
    load.request.type = "datmo_fusion/" + type;
    return ros::service::call("/perception/load_nodelet", load) && load.response.success;
  }

  std::vector<std::string> loaded() {
    nodelet::NodeletList list;
    EXPECT_TRUE(ros::service::call("/perception/list", list)) << "the manager lives";
    return list.response.nodelets;
  }

  void expectOneMessageWith(const std::vector<std::string>& parts) {
    ASSERT_TRUE(waitFor([this] { return !fatal_.empty(); }));
    EXPECT_EQ(fatal_.size(), 1U);
    for (const std::string& part : parts) {
      EXPECT_NE(fatal_[0].find(part), std::string::npos) << part << " not in: " << fatal_[0];
    }
  }

  ros::NodeHandle node_;
  ros::Subscriber log_;
  std::vector<std::string> fatal_;
};

TEST_F(BadParametersTest, AMisspelledKeyNamesTheNearestOne) {
  ros::param::set("/misspelled/map/cellsize", 0.2);
  EXPECT_FALSE(load("/misspelled", "grid_slam"));
  expectOneMessageWith({"/misspelled", "map/cellsize", "0.2", "map/cell_size"});
  EXPECT_TRUE(loaded().empty());
}

TEST_F(BadParametersTest, AValueOutOfRangeNamesTheRange) {
  ros::param::set("/too_large/transform_wait", 100.0);
  EXPECT_FALSE(load("/too_large", "tracker"));
  expectOneMessageWith({"/too_large", "transform_wait", "100", "0 to 5"});
}

TEST_F(BadParametersTest, AWrongTypeNamesTheType) {
  ros::param::set("/wrong_type/min_points", "many");
  EXPECT_FALSE(load("/wrong_type", "moving_objects"));
  expectOneMessageWith({"/wrong_type", "min_points", "'many'", "a whole number"});
}

TEST_F(BadParametersTest, WithTheCorrectedValueTheNodeletStarts) {
  ros::param::set("/right/map/cell_size", 0.2);
  EXPECT_TRUE(load("/right", "grid_slam"));
  EXPECT_EQ(loaded(), std::vector<std::string>{"/right"});
}

}  // namespace
}  // namespace datmo::bad_parameters_test
