// SPDX-License-Identifier: BSD-3-Clause
#include "cloud_street.h"

#include <algorithm>
#include <cmath>

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/common/random.h"

namespace datmo {

namespace {

constexpr int kRows = 64;
constexpr int kColumns = 2032;         // 130,048 points
constexpr double kLidarHeight = 1.73;  // m

}  // namespace

LidarCloud cloudOfStreet() {
  Random random(1);
  LidarCloud cloud;
  cloud.lidar_in_base.translation().z() = kLidarHeight;
  for (int row = 0; row < kRows; ++row) {
    const double slope = std::tan(degrees(2.0 - 26.8 * row / (kRows - 1)));
    for (int column = 0; column < kColumns; ++column) {
      const double bearing = 2.0 * kPi * column / kColumns;
      double range = std::min(80.0, 8.0 / std::max(1e-6, std::abs(std::sin(bearing))));
      range = std::abs(bearing) < 0.08 ? 12.0 : range;
      range = slope < 0.0 ? std::min(range, -kLidarHeight / slope) : range;
      range += random.normal(0.02);
      cloud.points->push_back({static_cast<float>(range * std::cos(bearing)),
                               static_cast<float>(range * std::sin(bearing)),
                               static_cast<float>(range * slope)});
      cloud.times.push_back(static_cast<float>(0.1 * column / kColumns));
    }
  }
  return cloud;
}

}  // namespace datmo
