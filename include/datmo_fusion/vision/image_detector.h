// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Geometry>

#include "datmo_fusion/common/object.h"

namespace cv {
class Mat;
}

namespace datmo {

/// A road user detected in an image.
struct ImageDetection {
  Eigen::AlignedBox2d box;  ///< px, may extend beyond the image
  ObjectClass object_class = ObjectClass::kUnknown;
  double score = 0.0;  ///< 0 to 1, higher is more certain; uncalibrated
};

/// Where in an image an object of the scanner is expected.
struct ImageRegion {
  Eigen::AlignedBox2d box;     ///< px, within the image, not empty: the object without uncertainty
  Eigen::AlignedBox2d search;  ///< px, within the image: the same with its uncertainty
  double scale = 0.0;          ///< px / m at its distance, > 0
};

/// Detects road users in images. Scores are calibrated separately: ClassReliability. Not thread
/// safe.
class ImageDetector {
 public:
  virtual ~ImageDetector() = default;

  /// `image`: 8 bit, gray or BGR, rectified, not empty (else std::invalid_argument). `regions`: for
  /// detectors that search only there. Deterministic.
  virtual std::vector<ImageDetection> detect(const cv::Mat& image,
                                             const std::vector<ImageRegion>& regions) = 0;
};

/// Returns the intersection over union of two rectangles, 0 to 1; 0 for empty ones.
double overlap(const Eigen::AlignedBox2d& a, const Eigen::AlignedBox2d& b);

/// Removes each detection that overlaps a more certain one of its class by more than `max_overlap`
/// (greedy non-maximum suppression). The result is sorted by decreasing score.
std::vector<ImageDetection> withoutDuplicates(std::vector<ImageDetection> detections,
                                              double max_overlap);

}  // namespace datmo
