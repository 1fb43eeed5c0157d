// SPDX-License-Identifier: BSD-3-Clause
#include "stereo_matcher.h"

#include <string>

#include <boost/make_shared.hpp>
#include <image_geometry/stereo_camera_model.h>
#include <opencv2/imgproc.hpp>
#include <stereo_image_proc/processor.h>

#include <sensor_msgs/image_encodings.h>

#include "datmo_fusion/ros/convert/stereo_image_conversion.h"

namespace datmo {

namespace {

namespace encodings = sensor_msgs::image_encodings;

/// Disparities are searched in blocks of this many (OpenCV).
constexpr int kDisparityBlock = 16;

int oddFrom(int size) { return size | 1; }

/// With values made valid as in the nodelet: odd windows, whole blocks of disparities.
std::unique_ptr<stereo_image_proc::StereoProcessor> makeProcessor(
    const StereoImagesOptions& options) {
  using stereo_image_proc::StereoProcessor;
  auto processor = std::make_unique<StereoProcessor>();
  const bool semi_global = options.stereo_algorithm == 1;
  processor->setStereoType(semi_global ? StereoProcessor::SGBM : StereoProcessor::BM);
  processor->setInterpolation(cv::INTER_LINEAR);
  processor->setPreFilterSize(oddFrom(options.prefilter_size));
  processor->setPreFilterCap(options.prefilter_cap);
  processor->setCorrelationWindowSize(oddFrom(options.correlation_window_size));
  processor->setMinDisparity(options.min_disparity);
  processor->setDisparityRange(options.disparity_range / kDisparityBlock * kDisparityBlock);
  processor->setTextureThreshold(options.texture_threshold);
  processor->setUniquenessRatio(static_cast<float>(options.uniqueness_ratio));
  processor->setSpeckleSize(options.speckle_size);
  processor->setSpeckleRange(options.speckle_range);
  processor->setSgbmMode(options.full_dp);
  processor->setP1(static_cast<int>(options.small_change_price));
  processor->setP2(static_cast<int>(options.large_change_price));
  processor->setDisp12MaxDiff(options.left_right_difference);
  return processor;
}

}  // namespace

StereoMatcher::StereoMatcher(const StereoImagesOptions& options) : rectified_(options.rectified) {
  checkOptions(options);
  processor_ = makeProcessor(options);
}

StereoMatcher::~StereoMatcher() = default;

sensor_msgs::PointCloud2Ptr StereoMatcher::cloudOf(const StereoPair& pair) const {
  try {
    return match(pair);
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& error) {  // from OpenCV, cv_bridge and image_geometry
    std::string said = error.what();
    said.erase(said.find_last_not_of('\n') + 1);
    throw InputError("bad_images", "images that stereo_image_proc cannot process: " + said);
  }
}

sensor_msgs::PointCloud2Ptr StereoMatcher::match(const StereoPair& pair) const {
  const image_geometry::StereoCameraModel model = stereoModel(pair);
  const cv::Mat color = rectifiedImage(pair.left.image, "", model.left(), rectified_);
  const cv::Mat left = rectifiedImage(pair.left.image, encodings::MONO8, model.left(), rectified_);
  const cv::Mat right =
      rectifiedImage(pair.right.image, encodings::MONO8, model.right(), rectified_);
  stereo_msgs::DisparityImage disparity;
  processor_->processDisparity(left, right, model, disparity);
  auto cloud = boost::make_shared<sensor_msgs::PointCloud2>();
  processor_->processPoints2(disparity, color, pair.left.image->encoding, model, *cloud);
  cloud->header = pair.left.image->header;
  return cloud;
}

}  // namespace datmo
