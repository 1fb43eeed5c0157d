// SPDX-License-Identifier: BSD-3-Clause
#include "managed_nodelet.h"

#include <algorithm>
#include <utility>

#include "restart_argument.h"

#include <nodelet/NodeletList.h>
#include <nodelet/NodeletUnload.h>
#include <ros/ros.h>

namespace datmo {

ManagedNodelet::ManagedNodelet(const std::string& manager, const std::string& type,
                               std::vector<std::string> arguments)
    : manager_(ros::names::resolve(manager)), arguments_(std::move(arguments)) {
  load_.request.name = ros::this_node::getName();
  load_.request.type = type;
  for (const auto& [from, to] : ros::names::getRemappings()) {
    load_.request.remap_source_args.push_back(from);
    load_.request.remap_target_args.push_back(to);
  }
}

bool ManagedNodelet::isLoaded() {
  const bool is_loaded = ask() && std::count(known_.begin(), known_.end(), load_.request.name) > 0;
  was_loaded_ = was_loaded_ || is_loaded;
  is_cut_off_ = is_cut_off_ && !is_loaded;
  return is_loaded;
}

bool ManagedNodelet::load() {
  load_.request.my_argv = arguments_;
  if (was_loaded_ && is_cut_off_) {
    ++restarts_;
    is_cut_off_ = false;
  }
  if (restarts_ > 0) {
    load_.request.my_argv.insert(load_.request.my_argv.end(),
                                 {kRestartsArgument, std::to_string(restarts_)});
  }
  return ros::service::call(manager_ + "/load_nodelet", load_);
}

void ManagedNodelet::unload() {
  nodelet::NodeletUnload unload;
  unload.request.name = load_.request.name;
  ros::service::call(manager_ + "/unload_nodelet", unload);
}

bool ManagedNodelet::ask() {
  if (!list_.isValid()) {
    is_cut_off_ = true;  // even if the next manager already responds
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

}  // namespace datmo
