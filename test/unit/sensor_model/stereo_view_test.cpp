// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/sensor_model/stereo_view.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "datmo_fusion/common/random.h"

namespace datmo::stereo_view_test {
namespace {

StereoCloud pitchedCamera() {
  StereoCloud cloud;
  cloud.camera = {480.0, 0.34, DepthNoise::ofDisparity(480.0, 0.34, 0.25), -0.7, 0.7};
  cloud.camera_in_base.linear() << 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0;
  cloud.camera_in_base.rotate(Eigen::AngleAxisd(0.1, Eigen::Vector3d(0.6, 0.0, 0.8)));
  cloud.camera_in_base.translation() = Eigen::Vector3d(1.8, 0.1, 1.3);
  return cloud;
}

bool sameBits(float a, float b) {
  return std::memcmp(&a, &b, sizeof a) == 0 || (std::isnan(a) && std::isnan(b));
}

TEST(StereoView, PointsTogetherAreAsOneByOneToTheBit) {
  Random random(1);
  std::vector<float> numbers;
  for (int i = 0; i < 300; ++i) {
    numbers.push_back(static_cast<float>(random.normal(5.0)));
  }
  numbers[7] = std::numeric_limits<float>::quiet_NaN();
  numbers[31] = std::numeric_limits<float>::infinity();
  PointsView points;
  points.data = reinterpret_cast<const std::uint8_t*>(numbers.data());
  points.step = 3 * sizeof(float);
  points.count = 100;
  const StereoView view(pitchedCamera(), RoadPlane{0.1, 0.02, -0.01});
  ViewedPoints viewed;
  const auto check = [&](std::size_t begin, std::size_t count) {
    view.view(points, begin, count, viewed);
    for (std::size_t i = 0; i < count; ++i) {
      const ViewedPoint one = view(points[begin + i]);
      EXPECT_TRUE(sameBits(viewed.forward[i], one.forward)) << begin + i;
      EXPECT_TRUE(sameBits(viewed.right[i], one.right)) << begin + i;
      EXPECT_TRUE(sameBits(viewed.height[i], one.height)) << begin + i;
      EXPECT_TRUE(sameBits(viewed.inverse[i], 1.0F / one.forward)) << begin + i;
    }
  };
  for (const float shift : {0.0F, 0.02F, -0.2F}) {
    SCOPED_TRACE(shift);
    points.inverse_shift = shift;
    check(0, ViewedPoints::kMax);
    check(ViewedPoints::kMax, points.count - ViewedPoints::kMax);
  }
}

}  // namespace
}  // namespace datmo::stereo_view_test
