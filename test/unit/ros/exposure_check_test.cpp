// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/exposure_check.h"

#include <cstddef>
#include <cstdint>
#include <string>

#include "camera_samples.h"
#include <boost/make_shared.hpp>
#include <gtest/gtest.h>

#include "datmo_fusion/ros/stage/input_error.h"

namespace datmo::exposure_check_test {
namespace {

/// Stripes, except for uniform gray from one row to another, in shares of the height.
sensor_msgs::ImagePtr stripes(std::uint32_t height, double from, double to, std::uint8_t gray) {
  const samples::CameraSample camera{16, height, 10.0};
  auto image = boost::make_shared<sensor_msgs::Image>(camera.image(1.0, 40));
  for (std::size_t i = 0; i < image->data.size(); ++i) {
    const double row = static_cast<double>(i / image->step);
    const bool is_filled = row >= from * height && row < to * height;
    image->data[i] = is_filled ? gray : (i % 2 == 0 ? 40 : 200);
  }
  return image;
}

/// Empty: none.
std::string faultOf(const sensor_msgs::ImagePtr& image) {
  try {
    ExposureCheck(ExposureCheckOptions()).check(image);
  } catch (const InputError& error) {
    return error.reason();
  }
  return "";
}

TEST(ExposureCheck, AClippedRoadOrHoodAtNightIsNoCutImage) {
  EXPECT_EQ(faultOf(stripes(40, 0.5, 1.0, 0)), "");
  EXPECT_EQ(faultOf(stripes(40, 0.75, 1.0, 1)), "");
}

TEST(ExposureCheck, UniformGrayIsCut) {
  EXPECT_EQ(faultOf(stripes(40, 0.5, 1.0, 128)), "half_image");
  EXPECT_EQ(faultOf(stripes(40, 0.75, 1.0, 255)), "half_image");
  EXPECT_EQ(faultOf(stripes(40, 0.0, 0.5, 128)), "half_image");
  EXPECT_EQ(faultOf(stripes(40, 0.0, 0.5, 255)), "") << "the sky";
  EXPECT_EQ(faultOf(stripes(40, 0.0, 1.0, 0)), "blank_image");
}

TEST(ExposureCheck, AnImageOfFewRowsHasNoQuarters) {
  for (std::uint32_t rows = 1; rows <= 4; ++rows) {
    EXPECT_EQ(faultOf(stripes(rows, 0.0, 0.0, 0)), "") << rows;
    EXPECT_EQ(faultOf(stripes(rows, 0.0, 1.0, 0)), "blank_image") << rows;
  }
}

}  // namespace
}  // namespace datmo::exposure_check_test
