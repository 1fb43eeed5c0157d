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

constexpr int kQuarters = 4;

/// Gray levels: any exposure has more noise, unless it is clipped.
constexpr double kLeastNoise = 0.5;
constexpr double kBlack = 2.0;
constexpr double kWhite = 253.0;

struct Contrast {
  double mean = 0.0;       ///< gray levels
  double deviation = 0.0;  ///< gray levels, standard
};

Contrast contrastOf(const cv::Mat& image) {
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(image, mean, deviation);
  return {mean[0], deviation[0]};
}

/// Whether a quarter of the image's height was not transmitted and is uniformly gray. Black does
/// not count, because a road and the own hood are clipped at night; nor does white in the upper
/// half, which may be sky. Images with too few rows are not judged.
bool lacksPart(const cv::Mat& image) {
  if (image.rows < kQuarters) {
    return false;
  }
  for (int quarter = 0; quarter < kQuarters; ++quarter) {
    const Contrast part = contrastOf(
        image.rowRange(quarter * image.rows / kQuarters, (quarter + 1) * image.rows / kQuarters));
    const bool may_be_sky = 2 * quarter < kQuarters && part.mean > kWhite;
    if (part.deviation < kLeastNoise && part.mean >= kBlack && !may_be_sky) {
      return true;
    }
  }
  return false;
}

}  // namespace

void ExposureCheckOptions::visit(OptionVisitor& visitor) {
  visitor.number({"min_contrast", "1",
                  "an image whose gray levels have a smaller standard deviation is blank: black, "
                  "white or covered"},
                 min_contrast, {0.0, 100.0});
}

void ExposureCheck::check(const sensor_msgs::ImageConstPtr& image) const {
  const auto pixels = grayOrColor(image);
  const double contrast = contrastOf(pixels->image).deviation;
  if (contrast < options_.min_contrast) {
    throw InputError("blank_image", "image whose gray levels differ by " +
                                        std::to_string(contrast) +
                                        " (standard deviation): expected " +
                                        std::to_string(options_.min_contrast) +
                                        " or more; is the camera covered or not exposed?");
  }
  if (lacksPart(pixels->image)) {
    throw InputError("half_image",
                     "image with one gray level in a quarter of it or more: expected a complete "
                     "exposure; is it cut off in transmission?");
  }
  if (last_ && last_->data == image->data && last_->header.stamp < image->header.stamp) {
    throw InputError("frozen_image",
                     "image with the same pixels as the last one, taken " +
                         std::to_string(secondsBetween(toStamp(last_->header.stamp),
                                                       toStamp(image->header.stamp))) +
                         " s before: expected a new exposure");
  }
}

}  // namespace datmo
