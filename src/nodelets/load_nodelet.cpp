// SPDX-License-Identifier: BSD-3-Clause
// Loads a nodelet into its manager, and again into the next manager when that one has died:
//   load_nodelet load TYPE MANAGER [argument of the nodelet...]
// Used by roslaunch in place of `nodelet load`, which ends with its manager. Name, parameters and
// remappings are those of the node.
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "restart_argument.h"

#include <nodelet/NodeletList.h>
#include <nodelet/NodeletLoad.h>
#include <nodelet/NodeletUnload.h>
#include <ros/ros.h>

namespace {

constexpr double kPeriod = 0.5;  // s, polling period of the manager

volatile std::sig_atomic_t stop_requested = 0;

void requestStop(int /*signal*/) { stop_requested = 1; }

bool runs() { return ros::ok() && stop_requested == 0; }

/// Requests to one manager about one nodelet, which has the node's own name.
class ManagedNodelet {
 public:
  ManagedNodelet(const std::string& manager, const std::string& type,
                 std::vector<std::string> arguments)
      : manager_(ros::names::resolve(manager)), arguments_(std::move(arguments)) {
    load_.request.name = ros::this_node::getName();
    load_.request.type = type;
    for (const auto& [from, to] : ros::names::getRemappings()) {
      load_.request.remap_source_args.push_back(from);
      load_.request.remap_target_args.push_back(to);
    }
  }

  const std::string& manager() const { return manager_; }

  /// Whether the manager responds.
  bool isThere() { return ask(); }

  /// Whether the manager responds that it has the nodelet.
  bool isLoaded() {
    const bool is_loaded =
        ask() && std::count(known_.begin(), known_.end(), load_.request.name) > 0;
    was_loaded_ = was_loaded_ || is_loaded;
    is_cut_off_ = is_cut_off_ && !is_loaded;
    return is_loaded;
  }

  bool wasLoaded() const { return was_loaded_; }

  /// False if the manager refuses to load it: its output says why.
  bool load() {
    load_.request.my_argv = arguments_;
    if (was_loaded_ && is_cut_off_) {
      ++restarts_;
      is_cut_off_ = false;
    }
    if (restarts_ > 0) {
      load_.request.my_argv.insert(load_.request.my_argv.end(),
                                   {datmo::kRestartsArgument, std::to_string(restarts_)});
    }
    return ros::service::call(manager_ + "/load_nodelet", load_);
  }

  void unload() {
    nodelet::NodeletUnload unload;
    unload.request.name = load_.request.name;
    ros::service::call(manager_ + "/unload_nodelet", unload);
  }

 private:
  /// Uses one connection as long as the manager lives, instead of asking the master each time.
  bool ask() {
    if (!list_.isValid()) {
      list_ = ros::NodeHandle().serviceClient<nodelet::NodeletList>(manager_ + "/list", true);
    }
    nodelet::NodeletList list;
    if (!list_.isValid() || !list_.call(list)) {
      list_.shutdown();
      is_cut_off_ = true;
      return false;
    }
    known_ = list.response.nodelets;
    return true;
  }

  std::string manager_;
  ros::ServiceClient list_;
  nodelet::NodeletLoad load_;
  std::vector<std::string> known_;
  std::vector<std::string> arguments_;
  bool was_loaded_ = false;
  bool is_cut_off_ = false;  ///< a request has failed since the manager last had the nodelet
  int restarts_ = 0;         ///< of the manager
};

/// Waits until the manager responds; returns false on shutdown.
bool waitForManager(ManagedNodelet& nodelet) {
  while (runs()) {
    if (nodelet.isThere()) {
      return true;
    }
    ros::WallDuration(kPeriod).sleep();
  }
  return false;
}

/// Returns if loading is refused (1), or on shutdown (0).
int keepLoaded(ManagedNodelet& nodelet) {
  while (waitForManager(nodelet)) {
    if (!nodelet.isLoaded()) {
      if (nodelet.wasLoaded()) {
        ROS_WARN("%s: no longer loaded in its manager %s: loads it again",
                 ros::this_node::getName().c_str(), nodelet.manager().c_str());
      }
      if (!nodelet.load() && nodelet.isThere()) {
        ROS_FATAL("%s: %s failed to load it; its output gives the reason",
                  ros::this_node::getName().c_str(), nodelet.manager().c_str());
        return 1;
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

int main(int argc, char** argv) {
  ros::init(argc, argv, "load_nodelet", ros::init_options::NoSigintHandler);
  std::signal(SIGINT, requestStop);
  std::signal(SIGTERM, requestStop);
  const std::vector<std::string> words(argv + 1, argv + argc);  // without ROS arguments
  if (words == std::vector<std::string>{"--help"}) {
    std::puts(kUsage);
    return 0;
  }
  if (words.size() < 3 || words[0] != "load") {
    ROS_FATAL("%s", kUsage);
    return 2;
  }
  ros::NodeHandle node;
  ros::AsyncSpinner spinner(1);  // answers requests of roslaunch and rosnode to this node
  spinner.start();
  ManagedNodelet nodelet(words[2], words[1], {words.begin() + 3, words.end()});
  return keepLoaded(nodelet);
}
