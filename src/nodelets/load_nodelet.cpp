// SPDX-License-Identifier: BSD-3-Clause
// Loads a nodelet into its manager, and again into the next manager when that one has died:
//   load_nodelet load TYPE MANAGER [argument of the nodelet...]
// Used by roslaunch in place of `nodelet load`, which ends with its manager. Name, parameters and
// remappings are those of the node.
#include <csignal>
#include <cstdio>
#include <string>
#include <vector>

#include "managed_nodelet.h"

#include <ros/ros.h>

namespace datmo {

namespace {

// s, polling periods of the manager. The requests of all loaders run in the thread that loads the
// nodelets: frequent ones only while there is no manager, which nothing can run without.
constexpr double kPeriod = 0.5;
constexpr double kPeriodWithoutManager = 0.1;

volatile std::sig_atomic_t stop_requested = 0;

void requestStop(int /*signal*/) { stop_requested = 1; }

bool runs() { return ros::ok() && stop_requested == 0; }

/// Waits until the manager responds; returns false on shutdown.
bool waitForManager(ManagedNodelet& nodelet) {
  while (runs()) {
    if (nodelet.isThere()) {
      return true;
    }
    ros::WallDuration(kPeriodWithoutManager).sleep();
  }
  return false;
}

/// Returns if loading is refused (1), or on shutdown (0).
int keepLoaded(ManagedNodelet& nodelet) {
  while (waitForManager(nodelet)) {
    if (!nodelet.isLoaded()) {
      const bool was_loaded = nodelet.wasLoaded();
      if (!nodelet.load()) {
        if (nodelet.isThere()) {
          ROS_FATAL("%s: %s failed to load it; its output gives the reason",
                    ros::this_node::getName().c_str(), nodelet.manager().c_str());
          return 1;
        }
      } else if (was_loaded) {
        // Only now: the first line on the console costs requests to the master.
        ROS_WARN("%s: was no longer loaded in its manager %s: has been loaded again",
                 ros::this_node::getName().c_str(), nodelet.manager().c_str());
      }
      nodelet.isLoaded();
    }
    ros::WallDuration(kPeriod).sleep();
  }
  if (ros::ok() && nodelet.isLoaded()) {
    nodelet.unload();
  }
  return 0;
}

constexpr char kUsage[] = "usage: load_nodelet load TYPE MANAGER [argument of the nodelet...]";

}  // namespace

}  // namespace datmo

int main(int argc, char** argv) {
  ros::init(argc, argv, "load_nodelet", ros::init_options::NoSigintHandler);
  std::signal(SIGINT, datmo::requestStop);
  std::signal(SIGTERM, datmo::requestStop);
  const std::vector<std::string> words(argv + 1, argv + argc);  // without ROS arguments
  if (words == std::vector<std::string>{"--help"}) {
    std::puts(datmo::kUsage);
    return 0;
  }
  if (words.size() < 3 || words[0] != "load") {
    ROS_FATAL("%s", datmo::kUsage);
    return 2;
  }
  ros::NodeHandle node;
  ros::AsyncSpinner spinner(1);  // answers requests of roslaunch and rosnode to this node
  spinner.start();
  datmo::ManagedNodelet nodelet(words[2], words[1], {words.begin() + 3, words.end()});
  return datmo::keepLoaded(nodelet);
}
