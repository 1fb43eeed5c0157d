// SPDX-License-Identifier: BSD-3-Clause
// The process of the nodelets, in place of `nodelet manager`, from which it differs in the number
// of requests to the master: they are sequential, and on a slow network they are what a restart
// waits for. Argument: manager.
#include <cstdio>
#include <future>
#include <string>
#include <vector>

#include <dlfcn.h>

#include <nodelet/loader.h>
#include <ros/param.h>
#include <ros/ros.h>
#include <ros/statistics.h>
#include <ros/subscription_callback_helper.h>

namespace {

constexpr char kUsage[] = "usage: nodelet_manager manager: the process in which load_nodelet loads";
constexpr char kNeeded[] = DATMO_FUSION_NEEDED_LIBRARY;

/// Parameters of roscpp's topic statistics, with its defaults. All subscriptions of a process have
/// those that are set when it begins.
struct StatisticsOptions {
  bool enabled = ros::param::param("/enable_statistics", false);
  int min_elements = valueOf("/statistics_window_min_elements", 10);
  int max_elements = valueOf("/statistics_window_max_elements", 100);
  int min_window = valueOf("/statistics_window_min_size", 4);   // s
  int max_window = valueOf("/statistics_window_max_size", 64);  // s

 private:
  /// Without statistics the others are not used.
  int valueOf(const char* parameter, int otherwise) const {
    return enabled ? ros::param::param(parameter, otherwise) : otherwise;
  }
};

}  // namespace

/// Replaces the function of libroscpp, as the dynamic linker prefers the program's: that one asks
/// for each of the parameters again for each subscription, under the lock of all subscriptions.
/// Without the replacement, everything works, only later.
void ros::StatisticsLogger::init(const SubscriptionCallbackHelperPtr& helper) {
  static const StatisticsOptions options;
  hasHeader_ = helper->hasHeader();
  enable_statistics = options.enabled;
  min_elements = options.min_elements;
  max_elements = options.max_elements;
  min_window = options.min_window;
  max_window = options.max_window;
}

int main(int argc, char** argv) {
  // While the master answers. What the library of the nodelets needs, without the nodelets, which
  // pluginlib loads: OpenCV alone depends on more than a hundred libraries.
  const auto needed = std::async(std::launch::async, [] { return dlopen(kNeeded, RTLD_LAZY); });
  ros::init(argc, argv, "manager");
  const std::vector<std::string> words(argv + 1, argv + argc);  // without ROS arguments
  if (words == std::vector<std::string>{"--help"}) {
    std::puts(kUsage);
    return 0;
  }
  if (words != std::vector<std::string>{"manager"}) {
    ROS_FATAL("%s", kUsage);
    return 2;
  }
  const nodelet::Loader loader;
  ros::spin();
  return 0;
}
