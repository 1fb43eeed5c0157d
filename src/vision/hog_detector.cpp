// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/vision/hog_detector.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "image_check.h"
#include <opencv2/imgproc.hpp>
#include <opencv2/objdetect.hpp>

namespace datmo {

namespace {

// The detector's window as trained: 64 x 128 px, with a person of 96 px in its center.
constexpr double kPersonPixels = 96.0;
constexpr double kPersonWidth = 0.5;    ///< of the window's
constexpr double kPersonHeight = 0.75;  ///< of the window's

constexpr double kPerson = 1.75;     ///< m
constexpr double kMargin = 0.75;     ///< m, around a person: of the window, and one step beside it
constexpr double kScaleStep = 1.06;  ///< ratio of consecutive person sizes that are tried
constexpr double kSmaller = 1.2;     ///< ratio of kPerson to the smallest size that is tried

cv::Rect toRect(const Eigen::AlignedBox2d& box) {
  const int x = static_cast<int>(std::floor(box.min().x()));
  const int y = static_cast<int>(std::floor(box.min().y()));
  return {x, y, static_cast<int>(std::ceil(box.max().x())) - x,
          static_cast<int>(std::ceil(box.max().y())) - y};
}

/// Crops the image; beyond its border its outermost pixels are repeated.
cv::Mat cropOf(const cv::Mat& image, const cv::Rect& wanted) {
  const cv::Rect inside = wanted & cv::Rect(0, 0, image.cols, image.rows);
  cv::Mat crop;
  cv::copyMakeBorder(image(inside), crop, inside.y - wanted.y,
                     wanted.y + wanted.height - inside.y - inside.height, inside.x - wanted.x,
                     wanted.x + wanted.width - inside.x - inside.width, cv::BORDER_REPLICATE);
  return crop;
}

/// The part in which a person fits, with the detector's margins, who stands in the region's columns
/// and on its lower edge, or is nearer or farther by its uncertainty.
Eigen::AlignedBox2d searchedPart(const ImageRegion& region) {
  const double margin = kMargin * region.scale;
  const double feet = region.box.max().y();
  Eigen::AlignedBox2d part;
  part.extend(
      Eigen::Vector2d(region.search.min().x() - margin, feet - kPerson * region.scale - margin));
  part.extend(Eigen::Vector2d(region.search.max().x() + margin, feet + margin));
  return part;
}

}  // namespace

class HogDetector::State {
 public:
  explicit State(const HogDetectorOptions& options) : options_(options) {
    hog_.setSVMDetector(cv::HOGDescriptor::getDefaultPeopleDetector());
  }

  std::vector<ImageDetection> detect(const cv::Mat& image, std::vector<ImageRegion> regions) const {
    // The nearest matter most.
    std::stable_sort(regions.begin(), regions.end(),
                     [](const auto& a, const auto& b) { return a.scale > b.scale; });
    regions.resize(std::min(regions.size(), static_cast<std::size_t>(options_.max_regions)));
    std::vector<ImageDetection> all;
    for (const ImageRegion& region : regions) {
      std::vector<ImageDetection> found = detectIn(image, region);
      std::move(found.begin(), found.end(), std::back_inserter(all));
    }
    return withoutDuplicates(std::move(all), options_.max_overlap);
  }

 private:
  std::vector<ImageDetection> detectIn(const cv::Mat& image, const ImageRegion& region) const {
    const double zoom = kSmaller * kPersonPixels / (kPerson * region.scale);
    if (zoom > options_.max_upscaling) {
      return {};
    }
    const cv::Rect part = toRect(searchedPart(region));
    cv::Mat scaled;
    cv::resize(cropOf(image, part), scaled, cv::Size(), zoom, zoom,
               zoom < 1.0 ? cv::INTER_AREA : cv::INTER_LINEAR);
    if (scaled.cols < hog_.winSize.width || scaled.rows < hog_.winSize.height) {
      return {};
    }
    std::vector<cv::Rect> windows;
    std::vector<double> scores;
    hog_.detectMultiScale(scaled, windows, scores, options_.min_score, cv::Size(8, 8), cv::Size(),
                          kScaleStep, 0.0);
    std::vector<ImageDetection> result;
    for (std::size_t i = 0; i < windows.size(); ++i) {
      const cv::Rect& window = windows[i];
      const Eigen::Vector2d middle(window.x + 0.5 * window.width, window.y + 0.5 * window.height);
      const Eigen::Vector2d half(0.5 * kPersonWidth * window.width,
                                 0.5 * kPersonHeight * window.height);
      const Eigen::Vector2d origin(part.x, part.y);
      result.push_back({{origin + (middle - half) / zoom, origin + (middle + half) / zoom},
                        ObjectClass::kPedestrian,
                        scores[i] / (1.0 + scores[i])});
    }
    return result;
  }

  HogDetectorOptions options_;
  cv::HOGDescriptor hog_;
};

void HogDetectorOptions::visit(OptionVisitor& visitor) {
  visitor.number({"min_score", "1", "minimum margin of a person, as its score"}, min_score,
                 {0.0, 10.0});
  visitor.integer({"max_regions", "1",
                   "maximum number of regions examined in an image, the nearest: bounds its time"},
                  max_regions, {1, 1000});
}

HogDetector::HogDetector(const Checked<HogDetectorOptions>& options)
    : state_(std::make_unique<State>(*options)) {}

HogDetector::~HogDetector() = default;

std::vector<ImageDetection> HogDetector::detect(const cv::Mat& image,
                                                const std::vector<ImageRegion>& regions) {
  checkImage(image);
  return state_->detect(image, regions);
}

}  // namespace datmo
