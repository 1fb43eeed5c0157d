// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/exposure_check.h"

#include <string>

#include <opencv2/core.hpp>

#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/ros/convert/image_conversion.h"
#include "datmo_fusion/ros/stage/input_error.h"
#include "datmo_fusion/ros/stage/stamp_check.h"

namespace datmo {

namespace {

double contrastOf(const cv::Mat& image) {
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(image, mean, deviation);
  return deviation[0];
}

}  // namespace

void ExposureCheckOptions::visit(OptionVisitor& visitor) {
  visitor.number({"min_contrast", "1",
                  "an image whose gray levels have a smaller standard deviation is blank: black, "
                  "white, covered"},
                 min_contrast, {0.0, 100.0});
}

void ExposureCheck::check(const sensor_msgs::ImageConstPtr& image) const {
  const double contrast = contrastOf(grayOrColor(image)->image);
  if (contrast < options_.min_contrast) {
    throw InputError("blank_image", "image whose gray levels differ by " +
                                        std::to_string(contrast) +
                                        " (standard deviation): expected " +
                                        std::to_string(options_.min_contrast) +
                                        " or more; is the camera covered or not exposed?");
  }
  if (last_ && last_->data == image->data && last_->header.stamp < image->header.stamp) {
    throw InputError("frozen_image",
                     "image of the same pixels as the last one, which was taken " +
                         std::to_string(secondsBetween(toStamp(last_->header.stamp),
                                                       toStamp(image->header.stamp))) +
                         " s before: expected a new exposure");
  }
}

}  // namespace datmo
