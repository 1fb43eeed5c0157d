// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/vision/image_detector.h"

namespace datmo {

struct DnnDetectorOptions {
  std::string model;       ///< path
  std::string labels;      ///< path; empty: COCO's
  int width = 832;         ///< px
  int height = 256;        ///< px
  double min_score = 0.3;  ///< 1
  /// 0 to 1: intersection over union of two detections of one class above which only the surer one
  /// is kept
  double max_overlap = 0.5;
  int close_look = 320;  ///< px; 0: none
  /// 1 to 4: size of the square of a close look in the image, relative to the person's
  double close_margin = 1.3;
  int max_close_looks = 4;

  void visit(OptionVisitor& visitor);
  void check() const;
};

/// Thrown for an unusable model; the message names the file, what is wrong, and what was expected.
class ModelError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A neural network run by cv::dnn: YOLO of Darknet (a .weights file with its .cfg beside it) or
/// YOLOX as ONNX. It processes the whole image once, and each detected person a second time at
/// higher resolution, because a downscaled image does not show whether a person rides a cycle.
/// Scores: 0 to 1, those of the network, uncalibrated.
class DnnDetector : public ImageDetector {
 public:
  /// Loads the model and runs it on empty images of both sizes (the whole image's, `close_look`),
  /// to detect a bad one at once. Throws ModelError for a file that is missing, truncated or of
  /// another kind, and for a network that does not take these sizes or whose outputs do not match
  /// its labels; OptionError.
  explicit DnnDetector(const Checked<DnnDetectorOptions>& options);
  ~DnnDetector() override;

  /// Regions are ignored.
  std::vector<ImageDetection> detect(const cv::Mat& image,
                                     const std::vector<ImageRegion>& regions) override;

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace datmo
