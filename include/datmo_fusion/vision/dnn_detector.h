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
  std::string model;          ///< path
  std::string labels;         ///< path; empty: COCO's
  int width = 832;            ///< px
  int height = 256;           ///< px
  double min_score = 0.3;     ///< 1
  double max_overlap = 0.5;   ///< 1
  int close_look = 320;       ///< px; 0: none
  double close_margin = 1.3;  ///< 1
  int max_close_looks = 4;

  void visit(OptionVisitor& visitor);
  void check() const;
};

/// A model that cannot be used: the message names the file, what is wrong, and what was expected.
class ModelError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A neural network by cv::dnn: YOLO of Darknet (a .weights file with its .cfg beside it) or YOLOX
/// as ONNX. It looks at the whole image once, and at each person that it sees a second time, close
/// up: whether a person rides a cycle is not to be seen in an image that was shrunk. Scores: 0 to
/// 1, a network's own, not calibrated.
class DnnDetector : public ImageDetector {
 public:
  /// Loads the model and looks at an empty image, so that a bad one is found at once. Throws
  /// ModelError, for a file that is missing, cut or of another kind and for a network with other
  /// outputs than its labels ask for; OptionError.
  explicit DnnDetector(const Checked<DnnDetectorOptions>& options);
  ~DnnDetector() override;

  /// Regions are not used.
  std::vector<ImageDetection> detect(const cv::Mat& image,
                                     const std::vector<ImageRegion>& regions) override;

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace datmo
