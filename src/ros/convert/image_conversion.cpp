// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/convert/image_conversion.h"

#include <cstddef>
#include <string>

#include <sensor_msgs/image_encodings.h>

#include "datmo_fusion/ros/stage/input_error.h"

namespace datmo {

namespace {

/// Applies `convert` to the image. Throws InputError (`bad_encoding`).
template <typename Convert>
auto converted(const sensor_msgs::Image& image, const Convert& convert) -> decltype(convert()) {
  const auto refuse = [&image](const std::string& why) {
    return InputError("bad_encoding",
                      "image of encoding '" + image.encoding + "', " + std::to_string(image.width) +
                          " x " + std::to_string(image.height) + " px, step " +
                          std::to_string(image.step) + ", " + std::to_string(image.data.size()) +
                          " bytes: expected a color or gray image (bgr8, rgb8, mono8, Bayer) of "
                          "that size: " +
                          why);
  };
  if (image.width == 0 || image.height == 0 ||
      image.data.size() < std::size_t{image.step} * image.height) {
    throw refuse("pixels are missing");
  }
  try {
    return convert();
  } catch (const cv_bridge::Exception& error) {
    throw refuse(error.what());
  } catch (const cv::Exception& error) {
    throw refuse(error.what());
  }
}

}  // namespace

cv_bridge::CvImagePtr colorCopy(const sensor_msgs::Image& image) {
  return converted(image,
                   [&] { return cv_bridge::toCvCopy(image, sensor_msgs::image_encodings::BGR8); });
}

cv_bridge::CvImageConstPtr grayOrColor(const sensor_msgs::ImageConstPtr& image) {
  return converted(*image, [&] {
    namespace encodings = sensor_msgs::image_encodings;
    return cv_bridge::toCvShare(
        image, encodings::isMono(image->encoding) ? encodings::MONO8 : encodings::BGR8);
  });
}

}  // namespace datmo
