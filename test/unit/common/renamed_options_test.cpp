// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/common/renamed_options.h"

#include <set>
#include <string>

#include <gtest/gtest.h>

#include "datmo_fusion/common/options.h"

namespace datmo::renamed_options_test {
namespace {

const std::set<std::string> kKeys = {"segmentation/max_gap", "segmentation/min_gap", "max_sigma",
                                     "scan_support/max_static_reach",
                                     "sources/lidar/false_agreement_probability"};

TEST(RenamedOption, LeastAndMostAreMinAndMax) {
  EXPECT_EQ(renamedOption("most_sigma", kKeys), "max_sigma");
}

TEST(RenamedOption, ExceptionsAreInTheTable) {
  EXPECT_EQ(renamedOption("segmentation/longest_gap", kKeys), "segmentation/max_gap");
  EXPECT_EQ(renamedOption("segmentation/shortest_gap", kKeys), "segmentation/min_gap");
  EXPECT_EQ(renamedOption("sources/lidar/coincidence", kKeys),
            "sources/lidar/false_agreement_probability");
}

TEST(RenamedOption, GroupAndOptionInItMayBothBeRenamed) {
  EXPECT_EQ(renamedOption("witness/most_static_reach", kKeys), "scan_support/max_static_reach");
}

TEST(RenamedOption, APresentKeyWasNotRenamed) {
  EXPECT_EQ(renamedOption("max_sigma", kKeys), std::nullopt);
}

TEST(RenamedOption, OnlyKeysAreNamed) {
  EXPECT_EQ(renamedOption("most_work", kKeys), std::nullopt);
  EXPECT_EQ(renamedOption("longest_gap", kKeys), std::nullopt);
  EXPECT_EQ(renamedOption("", kKeys), std::nullopt);
}

struct GateOptions {
  double max_gap = 1.0;
  void visit(OptionVisitor& visitor) { visitor.number({"max_gap", "m", "gap"}, max_gap, {}); }
};

TEST(RenamedOption, AFormerKeyIsRefusedAndThePresentOneNamed) {
  try {
    readOptions<GateOptions>({{"longest_gap", 0.5}});
    FAIL() << "accepted";
  } catch (const OptionError& error) {
    EXPECT_EQ(std::string(error.what()),
              "longest_gap = 0.5: the option was renamed, expected max_gap");
  }
}

}  // namespace
}  // namespace datmo::renamed_options_test
