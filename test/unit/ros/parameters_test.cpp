// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/parameters.h"

#include <gtest/gtest.h>

namespace datmo::parameters_test {
namespace {

using XmlRpc::XmlRpcValue;

TEST(Parameters, AreFlattenedWithTheirTypes) {
  XmlRpcValue tree;
  tree["map"]["cell_size"] = 0.3;
  tree["map"]["deeper"]["cells"] = 7;
  tree["odometry"] = true;
  tree["frame"] = "map";
  const OptionValues expected{{"map/cell_size", 0.3},
                              {"map/deeper/cells", 7},
                              {"odometry", true},
                              {"frame", std::string("map")}};
  EXPECT_EQ(flattenParameters(tree, "/node"), expected);
}

TEST(Parameters, ListsOfNumbersAreRead) {
  XmlRpcValue tree;
  tree["map"]["sizes"][0] = 1;
  tree["map"]["sizes"][1] = 0.5;
  const OptionValues expected{{"map/sizes", std::vector<double>{1.0, 0.5}}};
  EXPECT_EQ(flattenParameters(tree, "/node"), expected);
}

TEST(Parameters, OtherListsAreRefusedByName) {
  XmlRpcValue tree;
  tree["map"]["sizes"][0] = "large";
  try {
    flattenParameters(tree, "/node");
    FAIL() << "expected an OptionError";
  } catch (const OptionError& error) {
    EXPECT_NE(std::string(error.what()).find("map/sizes"), std::string::npos);
  }
}

TEST(Parameters, AValueInsteadOfTheNamespaceIsRefused) {
  EXPECT_THROW(flattenParameters(XmlRpcValue(3), "/node"), OptionError);
}

}  // namespace
}  // namespace datmo::parameters_test
