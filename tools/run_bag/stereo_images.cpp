// SPDX-License-Identifier: BSD-3-Clause
#include "stereo_images.h"

#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <boost/make_shared.hpp>
#include <cv_bridge/cv_bridge.h>
#include <image_geometry/stereo_camera_model.h>
#include <opencv2/imgproc.hpp>
#include <stereo_image_proc/processor.h>

#include <sensor_msgs/image_encodings.h>

namespace datmo {

namespace {

namespace encodings = sensor_msgs::image_encodings;

/// Bytes of a pixel, by the encodings that are read.
const std::map<std::string, std::size_t> kPixelSizes = {
    {encodings::MONO8, 1}, {encodings::RGB8, 3}, {encodings::BGR8, 3}};

/// Disparities are searched in blocks of so many (OpenCV).
constexpr int kDisparityBlock = 16;

int oddFrom(int size) { return size | 1; }

/// With values made valid as the nodelet does it: odd windows, whole blocks of disparities.
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

std::string sizeText(std::size_t width, std::size_t height) {
  return std::to_string(width) + " x " + std::to_string(height);
}

/// Throws InputError unless the image can be read.
void checkImage(const sensor_msgs::Image& image) {
  const auto pixel_size = kPixelSizes.find(image.encoding);
  if (pixel_size == kPixelSizes.end()) {
    throw InputError("bad_encoding",
                     "image of encoding '" + image.encoding + "': expected mono8, rgb8 or bgr8");
  }
  const std::size_t row = pixel_size->second * image.width;
  if (image.width == 0 || image.height == 0 || image.step < row ||
      image.data.size() != static_cast<std::size_t>(image.step) * image.height) {
    throw InputError("wrong_size", "image of " + sizeText(image.width, image.height) + " with " +
                                       std::to_string(image.data.size()) + " bytes in rows of " +
                                       std::to_string(image.step) + ": expected rows of " +
                                       std::to_string(row) + " bytes or more, and all of them");
  }
}

/// Throws InputError unless the calibration is of the image.
void checkInfo(const sensor_msgs::CameraInfo& info, const sensor_msgs::Image& image) {
  if (info.width != image.width || info.height != image.height) {
    throw InputError("wrong_size", "image of " + sizeText(image.width, image.height) +
                                       " with a calibration for " +
                                       sizeText(info.width, info.height) +
                                       ": expected one for the image's size");
  }
  if (info.binning_x > 1 || info.binning_y > 1 || info.roi.width != 0 || info.roi.height != 0) {
    throw InputError("bad_calibration",
                     "camera_info with binning or a region of interest:"
                     " expected whole images");
  }
  for (const auto* values : {&info.K[0], &info.P[0]}) {
    if (!(values[0] > 0.0) || !std::isfinite(values[0])) {
      throw InputError("bad_calibration", "focal length of " + std::to_string(values[0]) +
                                              " px: expected more than 0 px (K and P)");
    }
  }
}

/// The two cameras as one. Throws InputError unless they are a rectified stereo pair; the library
/// would end the process.
image_geometry::StereoCameraModel modelOf(const sensor_msgs::CameraInfo& left,
                                          const sensor_msgs::CameraInfo& right) {
  constexpr std::size_t kFx = 0;
  constexpr std::size_t kFy = 5;
  constexpr std::size_t kCy = 6;
  constexpr std::size_t kTx = 3;
  for (const std::size_t same : {kFx, kFy, kCy}) {
    if (left.P[same] != right.P[same]) {
      throw InputError("bad_calibration",
                       "P[" + std::to_string(same) + "] is " + std::to_string(left.P[same]) +
                           " of the left camera and " + std::to_string(right.P[same]) +
                           " of the right one: expected the same, of a rectified pair");
    }
  }
  if (!(right.P[kTx] < left.P[kTx])) {
    throw InputError("bad_calibration", "P[3] of the right camera is " +
                                            std::to_string(right.P[kTx]) +
                                            ": expected -focal length * baseline, less than 0");
  }
  if (left.header.frame_id != right.header.frame_id) {
    throw InputError("unknown_frame", "cameras in frames '" + left.header.frame_id + "' and '" +
                                          right.header.frame_id +
                                          "': expected both in the left camera's (REP 104)");
  }
  image_geometry::StereoCameraModel model;
  model.fromCameraInfo(left, right);
  return model;
}

cv::Mat rectified(const cv::Mat& image, const image_geometry::PinholeCameraModel& camera) {
  cv::Mat result;
  camera.rectifyImage(image, result, cv::INTER_LINEAR);
  return result;
}

}  // namespace

StereoImages::StereoImages(const StereoImagesOptions& options, StageMonitor& monitor)
    : rectified_(options.rectified),
      monitor_(monitor),
      pairs_(options.approximate_sync ? options.pair_tolerance : 0.0),
      runner_(monitor, StreamOptions(), "forgets all images", [this] { pairs_.clear(); }) {
  checkOptions(options);
  processor_ = makeProcessor(options);
}

StereoImages::~StereoImages() = default;

sensor_msgs::PointCloud2Ptr StereoImages::takeImage(StereoSide side,
                                                    const sensor_msgs::ImageConstPtr& image) {
  return runner_.serve([&] {
    runner_.check(side == StereoSide::kLeft ? "left" : "right", image->header.stamp);
    checkImage(*image);
    return serve(pairs_.takeImage(side, image));
  });
}

sensor_msgs::PointCloud2Ptr StereoImages::takeInfo(StereoSide side,
                                                   const sensor_msgs::CameraInfoConstPtr& info) {
  return runner_.serve([&] { return serve(pairs_.takeInfo(side, info)); });
}

sensor_msgs::PointCloud2Ptr StereoImages::serve(const std::optional<StereoPair>& pair) {
  if (pairs_.unpaired() > unpaired_) {
    unpaired_ = pairs_.unpaired();
    monitor_.warned(InputError("unpaired_image",
                               "an image without its calibration or without one of the other "
                               "camera: expected all four messages of one stamp, or with "
                               "approximate_sync of nearly one"));
  }
  if (!pair) {
    return nullptr;
  }
  try {
    const sensor_msgs::PointCloud2Ptr cloud = cloudOf(*pair);
    runner_.processed(pair->left.stamp);
    return cloud;
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& error) {  // of OpenCV, cv_bridge and image_geometry
    std::string said = error.what();
    said.erase(said.find_last_not_of('\n') + 1);
    throw InputError("bad_images", "images that stereo_image_proc cannot take: " + said);
  }
}

sensor_msgs::PointCloud2Ptr StereoImages::cloudOf(const StereoPair& pair) const {
  const sensor_msgs::ImageConstPtr& left_image = pair.left.image;
  const sensor_msgs::ImageConstPtr& right_image = pair.right.image;
  checkInfo(*pair.left.info, *left_image);
  checkInfo(*pair.right.info, *right_image);
  if (left_image->width != right_image->width || left_image->height != right_image->height) {
    throw InputError("wrong_size", "left image of " +
                                       sizeText(left_image->width, left_image->height) +
                                       " and right image of " +
                                       sizeText(right_image->width, right_image->height) +
                                       ": expected the same size");
  }
  const auto model = modelOf(*pair.left.info, *pair.right.info);
  const auto rectify = [this](const cv_bridge::CvImageConstPtr& image, const auto& camera) {
    return rectified_ ? image->image : rectified(image->image, camera);
  };
  const cv::Mat color = rectify(cv_bridge::toCvShare(left_image), model.left());
  const cv::Mat left = rectify(cv_bridge::toCvShare(left_image, encodings::MONO8), model.left());
  const cv::Mat right = rectify(cv_bridge::toCvShare(right_image, encodings::MONO8), model.right());
  stereo_msgs::DisparityImage disparity;
  processor_->processDisparity(left, right, model, disparity);
  auto cloud = boost::make_shared<sensor_msgs::PointCloud2>();
  processor_->processPoints2(disparity, color, left_image->encoding, model, *cloud);
  cloud->header = left_image->header;
  return cloud;
}

void StereoImages::connect(StagePorts& ports) {
  const auto points = ports.out<sensor_msgs::PointCloud2>("points2");
  for (const auto& [side, name] :
       {std::pair(StereoSide::kLeft, "left/"), std::pair(StereoSide::kRight, "right/")}) {
    ports.in<sensor_msgs::CameraInfo>(std::string(name) + "camera_info",
                                      [this, points, side = side](const auto& info, Stamp /*now*/) {
                                        points.publish(takeInfo(side, info));
                                      });
    ports.in<sensor_msgs::Image>(std::string(name) + "image",
                                 [this, points, side = side](const auto& image, Stamp /*now*/) {
                                   points.publish(takeImage(side, image));
                                 });
  }
}

}  // namespace datmo
