// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>

#include <XmlRpcValue.h>

#include <ros/console.h>
#include <ros/node_handle.h>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/ros/shared_options.h"

namespace datmo {

/// Returns all values of a tree of the parameter server, keys relative to it; `name` is the tree's
/// name in messages.
///
/// Throws OptionError for values that no option can hold (dates, binary data, lists of anything but
/// numbers).
OptionValues flattenParameters(const XmlRpc::XmlRpcValue& tree, const std::string& name);

/// The parameters of a nodelet: its private namespace, and the sections beside it that all nodelets
/// share. They are read with one request to the master.
class NodeletParameters {
 public:
  explicit NodeletParameters(const ros::NodeHandle& private_node);

  /// Errors are printed on the console before OptionError is thrown; also by options().
  SharedOptions shared() const;

  /// The nodelet's options, including the shared ones.
  template <typename Options>
  Options options() const {
    const SharedOptions shared_options = shared();
    return reported([&] { return readStageOptions<Options>(valuesOf(name_), shared_options); });
  }

 private:
  /// Of a section; empty if it is not set.
  OptionValues valuesOf(const std::string& section) const;

  template <typename Read>
  auto reported(const Read& read) const {
    try {
      return read();
    } catch (const OptionError& error) {
      ROS_FATAL("%s does not start: %s", (around_ + name_).c_str(), error.what());
      throw;
    }
  }

  std::string around_;  ///< namespace of the sections, with a slash at the end
  std::string name_;
  std::map<std::string, XmlRpc::XmlRpcValue> sections_;  ///< those that are set
};

/// Loads the options of a nodelet, like NodeletParameters::options().
template <typename Options>
Options loadOptions(const ros::NodeHandle& private_node) {
  return NodeletParameters(private_node).options<Options>();
}

}  // namespace datmo
