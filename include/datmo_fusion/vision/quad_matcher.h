// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/vision/camera_motion.h"

namespace cv {
class Mat;
}

namespace datmo {

struct QuadMatcherOptions {
  /// 10 to 10000: maximum number of corners tracked in an image, the best ones
  int max_features = 1500;
  double min_distance = 5.0;  ///< px
  /// 0.00001 to 1: minimum quality of a corner, relative to the best one of the image
  double min_quality = 0.005;
  int window = 15;         ///< px
  int pyramid_levels = 3;  ///< 1
  /// px, 0.01 to 10: largest distance from its start at which a feature may end after tracking
  /// through all four images
  double max_closure = 0.5;
  double max_row_offset = 1.0;  ///< px

  void visit(OptionVisitor& visitor);
};

/// Matches features of the newest image pair to the one before: corners of the left image are
/// tracked to the right one, to the previous right and left ones, and back to their start. Features
/// that do not return to it, or do not stay on the rows of the rectified images, are dropped.
/// Sources: Shi and Tomasi, Good features to track, 1994; Bouguet, Pyramidal implementation of the
/// Lucas Kanade feature tracker, 2000; the circle of Geiger, Ziegler and Stiller, StereoScan, 2011.
class QuadMatcher {
 public:
  /// Throws OptionError.
  explicit QuadMatcher(const Checked<QuadMatcherOptions>& options);
  ~QuadMatcher();

  /// Images: rectified, 8 bit gray, of the same size (else std::invalid_argument). Returns nothing
  /// for the first pair, and for the first one of another size.
  std::vector<FeatureQuad> match(const cv::Mat& left, const cv::Mat& right);

  /// Forgets the images.
  void reset();

 private:
  struct Pyramids;

  QuadMatcherOptions options_;
  std::unique_ptr<Pyramids> last_;  ///< null: no images yet
};

}  // namespace datmo
