// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <XmlRpcValue.h>

#include <ros/console.h>
#include <ros/node_handle.h>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/ros/shared_options.h"

namespace datmo {

/// Reads all values of a namespace on the parameter server, keys relative to it.
///
/// Throws OptionError for values that no option can hold (lists, dates, binary data).
OptionValues readParameters(const ros::NodeHandle& node);

/// The same for a tree of values; `name` is the tree's name in messages.
OptionValues flattenParameters(const XmlRpc::XmlRpcValue& tree, const std::string& name);

/// Loads what all nodelets of a namespace share: the sections beside a nodelet's private namespace.
/// Errors are printed on the console before OptionError is thrown.
SharedOptions loadSharedOptions(const ros::NodeHandle& private_node);

/// Loads the options of a nodelet from its private namespace, and those shared by all nodelets
/// (`frames`, `motion`). Errors are printed on the console before OptionError is thrown.
template <typename Options>
Options loadOptions(const ros::NodeHandle& private_node) {
  const SharedOptions shared = loadSharedOptions(private_node);
  try {
    return readStageOptions<Options>(readParameters(private_node), shared);
  } catch (const OptionError& error) {
    ROS_FATAL("%s does not start: %s", private_node.getNamespace().c_str(), error.what());
    throw;
  }
}

}  // namespace datmo
