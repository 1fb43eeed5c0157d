// SPDX-License-Identifier: BSD-3-Clause
// The tests of all running nodelets: each .test runs one suite by its --gtest_filter.
#include <cstdlib>
#include <iostream>

#include <gtest/gtest.h>

#include <ros/ros.h>

namespace {

/// Otherwise a filter that matches no test would pass.
class EmptyRunRefusal : public testing::EmptyTestEventListener {
  void OnTestIterationStart(const testing::UnitTest& all, int /*iteration*/) override {
    if (all.test_to_run_count() == 0) {
      std::cerr << "no test matches --gtest_filter=" << testing::GTEST_FLAG(filter) << '\n';
      std::exit(EXIT_FAILURE);  // before there are results
    }
  }
};

}  // namespace

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "nodelet_tests");
  testing::UnitTest::GetInstance()->listeners().Append(new EmptyRunRefusal);
  return RUN_ALL_TESTS();
}
