// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Geometry>

#include "datmo_fusion/common/object.h"

namespace cv {
class Mat;
}

namespace datmo {

/// A road user that a detector sees in an image.
struct ImageDetection {
  Eigen::AlignedBox2d box;  ///< px, may reach out of the image
  ObjectClass object_class = ObjectClass::kUnknown;
  double score = 0.0;  ///< 0 to 1, the higher the surer; not calibrated
};

/// Where in an image an object of the scanner is expected.
struct ImageRegion {
  Eigen::AlignedBox2d box;     ///< px, inside of the image, not empty: the object as it is known
  Eigen::AlignedBox2d search;  ///< px, inside of the image: the same with its uncertainty
  double scale = 0.0;          ///< px / m at its distance, > 0
};

/// Finds road users in images. What a score is worth is no matter of the detector:
/// ClassReliability. Not thread safe.
class ImageDetector {
 public:
  virtual ~ImageDetector() = default;

  /// `image`: 8 bit, gray or BGR, rectified, not empty (else std::invalid_argument). `regions`: for
  /// detectors that look there alone. Same input, same output.
  virtual std::vector<ImageDetection> detect(const cv::Mat& image,
                                             const std::vector<ImageRegion>& regions) = 0;
};

/// Intersection over union of two rectangles, 0 to 1; 0 of empty ones.
double overlap(const Eigen::AlignedBox2d& a, const Eigen::AlignedBox2d& b);

/// Leaves out each detection that overlaps a surer one of its class by more than `max_overlap`
/// (greedy non-maximum suppression). Result by falling score.
std::vector<ImageDetection> withoutDuplicates(std::vector<ImageDetection> detections,
                                              double max_overlap);

}  // namespace datmo
