// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/vision/quad_matcher.h"

#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <utility>

#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

namespace datmo {

namespace {

using Pyramid = std::vector<cv::Mat>;
using Pixels = std::vector<cv::Point2f>;

/// px: side of the square in which corners are scored.
constexpr int kCornerBlock = 5;

/// px; a smaller disparity counts as infinitely far.
constexpr float kMinDisparity = 0.5F;

Pyramid pyramidOf(const cv::Mat& image, const QuadMatcherOptions& options) {
  Pyramid pyramid;
  cv::buildOpticalFlowPyramid(image, pyramid, cv::Size(options.window, options.window),
                              options.pyramid_levels);
  return pyramid;
}

/// Features that are still tracked: where they started, and where they are in each image.
class Circle {
 public:
  Circle(Pixels corners, const QuadMatcherOptions& options)
      : begun_(std::move(corners)), found_(begun_.size(), 1), options_(options) {}

  /// Tracks the features at `pixels` from one image to another.
  Pixels follow(const Pyramid& from, const Pyramid& to, const Pixels& pixels) {
    Pixels result;
    std::vector<unsigned char> status;
    std::vector<float> error;
    cv::calcOpticalFlowPyrLK(from, to, pixels, result, status, error,
                             cv::Size(options_.window, options_.window), options_.pyramid_levels);
    for (std::size_t i = 0; i < status.size(); ++i) {
      found_[i] = found_[i] != 0 && status[i] != 0 ? 1 : 0;
    }
    return result;
  }

  std::vector<FeatureQuad> quads(const Pixels& right, const Pixels& last_right,
                                 const Pixels& last_left, const Pixels& back) const {
    std::vector<FeatureQuad> quads;
    for (std::size_t i = 0; i < begun_.size(); ++i) {
      const cv::Point2f closure = back[i] - begun_[i];
      if (found_[i] != 0 && std::hypot(closure.x, closure.y) <= options_.max_closure &&
          isPair(begun_[i], right[i]) && isPair(last_left[i], last_right[i])) {
        quads.push_back({featureOf(last_left[i], last_right[i]), featureOf(begun_[i], right[i])});
      }
    }
    return quads;
  }

 private:
  bool isPair(const cv::Point2f& left, const cv::Point2f& right) const {
    return std::abs(left.y - right.y) <= options_.max_row_offset &&
           left.x - right.x >= kMinDisparity;
  }

  static StereoFeature featureOf(const cv::Point2f& left, const cv::Point2f& right) {
    return {{left.x, left.y}, static_cast<double>(left.x) - static_cast<double>(right.x)};
  }

  Pixels begun_;
  std::vector<char> found_;
  const QuadMatcherOptions& options_;
};

void check(const cv::Mat& left, const cv::Mat& right) {
  if (left.empty() || left.type() != CV_8UC1 || right.type() != CV_8UC1 ||
      left.size() != right.size()) {
    throw std::invalid_argument("image pair: expected two gray images of 8 bit and the same size");
  }
}

}  // namespace

struct QuadMatcher::Pyramids {
  Pyramid left;
  Pyramid right;
};

void QuadMatcherOptions::visit(OptionVisitor& visitor) {
  visitor.number({"min_distance", "px", "minimum distance between two corners"}, min_distance,
                 {1.0, 100.0});
  visitor.integer({"window", "px", "side of the square around a corner that is compared"}, window,
                  {5, 63});
  visitor.integer({"pyramid_levels", "1",
                   "halvings of the image: each doubles how far a feature may have moved"},
                  pyramid_levels, {0, 8});
  visitor.number(
      {"max_row_offset", "px", "largest difference between the rows of a feature in both images"},
      max_row_offset, {0.1, 10.0});
}

QuadMatcher::QuadMatcher(const Checked<QuadMatcherOptions>& options) : options_(*options) {}

QuadMatcher::~QuadMatcher() = default;

std::vector<FeatureQuad> QuadMatcher::match(const cv::Mat& left, const cv::Mat& right) {
  check(left, right);
  auto now =
      std::make_unique<Pyramids>(Pyramids{pyramidOf(left, options_), pyramidOf(right, options_)});
  const std::unique_ptr<Pyramids> last = std::exchange(last_, nullptr);
  last_ = std::move(now);
  if (!last || last->left.front().size() != left.size()) {
    return {};
  }
  Pixels corners;
  cv::goodFeaturesToTrack(left, corners, options_.max_features, options_.min_quality,
                          options_.min_distance, cv::noArray(), kCornerBlock);
  if (corners.empty()) {
    return {};
  }
  Circle circle(corners, options_);
  const Pixels to_right = circle.follow(last_->left, last_->right, corners);
  const Pixels last_right = circle.follow(last_->right, last->right, to_right);
  const Pixels last_left = circle.follow(last->right, last->left, last_right);
  const Pixels back = circle.follow(last->left, last_->left, last_left);
  return circle.quads(to_right, last_right, last_left, back);
}

void QuadMatcher::reset() { last_.reset(); }

}  // namespace datmo
