// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/vision/image_detector.h"

namespace datmo {

struct HogDetectorOptions {
  double min_score = 0.0;  ///< 1
  /// 0 to 1: intersection over union of two persons above which only the surer one is kept
  double max_overlap = 0.4;
  /// 1 to 10: persons that would have to be enlarged by more are not searched for: those smaller
  /// than 96 px over this
  double max_upscaling = 4.0;
  int max_regions = 20;

  void visit(OptionVisitor& visitor);
};

/// OpenCV's people detector (histograms of oriented gradients: Dalal and Triggs, 2005), which needs
/// no file. It searches only the regions, each scaled so that a person on the road there has the
/// height it was trained for. Reports pedestrians; it does not distinguish them from riders.
/// Scores: m / (1 + m) of the margin m of its support vector machine, 0 to 1.
class HogDetector : public ImageDetector {
 public:
  /// Throws OptionError.
  explicit HogDetector(const Checked<HogDetectorOptions>& options);
  ~HogDetector() override;

  std::vector<ImageDetection> detect(const cv::Mat& image,
                                     const std::vector<ImageRegion>& regions) override;

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace datmo
