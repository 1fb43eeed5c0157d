// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/display/legend.h"

#include <set>

#include <gtest/gtest.h>

namespace datmo::legend_test {
namespace {

TEST(Legend, IsAnImageOfItsSizeWithManyColors) {
  const sensor_msgs::ImagePtr legend = drawLegend();
  EXPECT_EQ(legend->encoding, "rgb8");
  EXPECT_EQ(legend->step, 3 * legend->width);
  ASSERT_EQ(legend->data.size(), std::size_t{legend->step} * legend->height);
  std::set<int> colors;
  for (std::size_t i = 0; i < legend->data.size(); i += 3) {
    colors.insert(legend->data[i] << 16 | legend->data[i + 1] << 8 | legend->data[i + 2]);
  }
  EXPECT_EQ(colors.count(13 << 16 | 102 << 8 | 242), 1U) << "a vehicle's blue";
  EXPECT_EQ(colors.count(229 << 16 | 13 << 8 | 140), 1U) << "a pedestrian's magenta";
  EXPECT_EQ(colors.count(255 << 16 | 140 << 8 | 26), 1U) << "the left border's orange";
}

}  // namespace
}  // namespace datmo::legend_test
