// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>

#include <dynamic_reconfigure/server.h>

#include <ros/console.h>
#include <ros/node_handle.h>

#include "datmo_fusion/common/options.h"

namespace datmo {

/// A choice by name, the one member of a `Config`, that dynamic_reconfigure changes while a stage
/// runs. A name that there is not is refused, and said.
template <typename Config>
class ChoiceServer {
 public:
  /// Sets the stage's choice; throws OptionError for a name that there is not.
  using Choose = std::function<void(const std::string&)>;

  /// `node`: the nodelet's private one; `member`: the choice; `now`: the one that holds.
  ChoiceServer(const ros::NodeHandle& node, std::string Config::*member, std::string now,
               Choose choose)
      : name_(node.getNamespace()),
        member_(member),
        chosen_(std::move(now)),
        choose_(std::move(choose)),
        server_(node) {
    server_.setCallback([this](Config& config, std::uint32_t /*level*/) { take(config); });
  }

 private:
  void take(Config& config) {
    std::string& asked = config.*member_;
    try {
      choose_(asked);
      chosen_ = asked;
    } catch (const OptionError& error) {
      ROS_ERROR_NAMED(name_, "%s; goes on with %s", error.what(), chosen_.c_str());
      asked = chosen_;
    }
  }

  std::string name_;  ///< of the nodelet
  std::string Config::*member_;
  std::string chosen_;
  Choose choose_;
  dynamic_reconfigure::Server<Config> server_;
};

}  // namespace datmo
