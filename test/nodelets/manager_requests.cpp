// SPDX-License-Identifier: BSD-3-Clause
#include "manager_requests.h"

#include <algorithm>

#include <nodelet/NodeletList.h>
#include <nodelet/NodeletLoad.h>
#include <nodelet/NodeletUnload.h>
#include <ros/ros.h>

namespace datmo {

bool areLoaded(const std::vector<std::string>& nodelets) {
  nodelet::NodeletList list;
  if (!ros::service::call("/perception/list", list)) {
    return false;
  }
  const auto& known = list.response.nodelets;
  return std::all_of(nodelets.begin(), nodelets.end(), [&](const std::string& nodelet) {
    return std::count(known.begin(), known.end(), "/" + nodelet) > 0;
  });
}

bool loadNodelet(const std::string& nodelet, const std::string& type) {
  nodelet::NodeletLoad call;
  call.request.name = "/" + nodelet;
  call.request.type = type;
  return ros::service::call("/perception/load_nodelet", call) && call.response.success;
}

bool unloadNodelet(const std::string& nodelet) {
  nodelet::NodeletUnload call;
  call.request.name = "/" + nodelet;
  return ros::service::call("/perception/unload_nodelet", call) && call.response.success;
}

}  // namespace datmo
