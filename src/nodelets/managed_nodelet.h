// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include <nodelet/NodeletLoad.h>
#include <ros/service_client.h>

namespace datmo {

/// Requests of a node to a nodelet manager about one nodelet, which has the node's own name and
/// remappings. Counts how often the nodelet was loaded again because its manager had ended.
class ManagedNodelet {
 public:
  /// `type`: as in nodelets.xml. `manager`: name of its node. `arguments`: of the nodelet.
  ManagedNodelet(const std::string& manager, const std::string& type,
                 std::vector<std::string> arguments);

  const std::string& manager() const { return manager_; }

  /// Whether the manager responds.
  bool isThere() { return ask(); }

  /// Whether the manager responds that it has the nodelet.
  bool isLoaded();

  /// Whether it has ever had it.
  bool wasLoaded() const { return was_loaded_; }

  /// Returns false if the manager refuses to load it: its output says why. After a restart of the
  /// manager, the nodelet gets kRestartsArgument.
  bool load();

  void unload();

 private:
  /// Uses one connection as long as the manager lives, instead of asking the master each time.
  bool ask();

  std::string manager_;
  ros::ServiceClient list_;
  nodelet::NodeletLoad load_;
  std::vector<std::string> known_;  ///< nodelets of the manager
  std::vector<std::string> arguments_;
  bool was_loaded_ = false;
  bool is_cut_off_ = false;  ///< not connected at some time since the manager last had the nodelet
  int restarts_ = 0;         ///< of the manager
};

}  // namespace datmo
