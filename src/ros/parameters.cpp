// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/parameters.h"

#include <ros/names.h>

namespace datmo {

namespace {

using XmlRpc::XmlRpcValue;

std::vector<double> numbersIn(XmlRpcValue& list, const std::string& key) {
  std::vector<double> numbers;
  for (int i = 0; i < list.size(); ++i) {
    if (list[i].getType() == XmlRpcValue::TypeInt) {
      numbers.push_back(static_cast<int>(list[i]));
    } else if (list[i].getType() == XmlRpcValue::TypeDouble) {
      numbers.push_back(static_cast<double>(list[i]));
    } else {
      throw OptionError(key + " = " + list.toXml() + ": expected only numbers in a list");
    }
  }
  return numbers;
}

void flattenInto(OptionValues& values, XmlRpcValue& tree, const std::string& key) {
  switch (tree.getType()) {
    case XmlRpcValue::TypeStruct:
      for (auto& [name, member] : tree) {
        flattenInto(values, member, key.empty() ? name : key + "/" + name);
      }
      break;
    case XmlRpcValue::TypeBoolean:
      values[key] = static_cast<bool>(tree);
      break;
    case XmlRpcValue::TypeInt:
      values[key] = static_cast<int>(tree);
      break;
    case XmlRpcValue::TypeDouble:
      values[key] = static_cast<double>(tree);
      break;
    case XmlRpcValue::TypeString:
      values[key] = static_cast<std::string>(tree);
      break;
    case XmlRpcValue::TypeArray:
      values[key] = numbersIn(tree, key);
      break;
    default:
      throw OptionError(key + " = " + tree.toXml() +
                        ": expected a number, true or false, text, a list of numbers, or a group "
                        "of them");
  }
}

}  // namespace

OptionValues flattenParameters(const XmlRpcValue& tree, const std::string& name) {
  XmlRpcValue copy = tree;
  OptionValues values;
  if (copy.getType() != XmlRpcValue::TypeStruct) {
    throw OptionError(name + " = " + copy.toXml() + ": expected a group of parameters");
  }
  flattenInto(values, copy, "");
  return values;
}

OptionValues readParameters(const ros::NodeHandle& node) {
  XmlRpcValue tree;
  if (!node.getParam(node.getNamespace(), tree)) {
    return {};
  }
  return flattenParameters(tree, node.getNamespace());
}

SharedOptions loadSharedOptions(const ros::NodeHandle& private_node) {
  const ros::NodeHandle around(ros::names::parentNamespace(private_node.getNamespace()));
  const auto section = [&around](const std::string& name) {
    return readParameters(ros::NodeHandle(around, name));
  };
  try {
    return readSharedOptions(section);
  } catch (const OptionError& error) {
    ROS_FATAL("%s does not start: %s", private_node.getNamespace().c_str(), error.what());
    throw;
  }
}

}  // namespace datmo
