// SPDX-License-Identifier: BSD-3-Clause
// The main of every unit test binary: catkin_add_gtest links none.
#include <gtest/gtest.h>

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
