// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/parameters.h"

#include "datmo_fusion/ros/master_requests.h"

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

NodeletParameters::NodeletParameters(const ros::NodeHandle& private_node) {
  const std::string full_name = private_node.getNamespace();
  const std::size_t slash = full_name.rfind('/');
  around_ = full_name.substr(0, slash + 1);
  name_ = full_name.substr(slash + 1);
  std::vector<std::string> names = sharedSections();
  names.insert(names.end(), {kStereoImagesSection, name_});
  std::vector<MasterRequest> requests;
  for (const std::string& name : names) {
    requests.push_back({"getParam", {XmlRpcValue(around_ + name)}});
  }
  const MasterAnswers answers = askMasterAtOnce(requests);
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (answers[i]) {
      sections_[names[i]] = *answers[i];
    }
  }
}

SharedOptions NodeletParameters::shared() const {
  return reported([this] {
    return readSharedOptions([this](const std::string& section) { return valuesOf(section); });
  });
}

OptionValues NodeletParameters::valuesOf(const std::string& section) const {
  const auto found = sections_.find(section);
  return found == sections_.end() ? OptionValues()
                                  : flattenParameters(found->second, around_ + section);
}

}  // namespace datmo
