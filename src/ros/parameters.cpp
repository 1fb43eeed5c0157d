#include "datmo_fusion/ros/parameters.h"

namespace datmo {

namespace {

using XmlRpc::XmlRpcValue;

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
    default:
      throw OptionError(key + " = " + tree.toXml() +
                        ": expected a number, true or false, text, or a group of them");
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

}  // namespace datmo
