#pragma once

#include <string>

#include <XmlRpcValue.h>

#include <ros/console.h>
#include <ros/node_handle.h>

#include "datmo_fusion/common/options.h"

namespace datmo {

/// All values of a namespace on the parameter server, keys relative to it.
///
/// Throws OptionError for what no option can hold (lists, dates, binary data).
OptionValues readParameters(const ros::NodeHandle& node);

/// The same for a tree of values; `name` stands in messages for the tree's own name.
OptionValues flattenParameters(const XmlRpc::XmlRpcValue& tree, const std::string& name);

/// The options of a nodelet from its private namespace. What is wrong with them is said on the
/// console before OptionError is thrown.
template <typename Options>
Options loadOptions(const ros::NodeHandle& private_node) {
  try {
    return readOptions<Options>(readParameters(private_node));
  } catch (const OptionError& error) {
    ROS_FATAL("%s does not start: %s", private_node.getNamespace().c_str(), error.what());
    throw;
  }
}

}  // namespace datmo
