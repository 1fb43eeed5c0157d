// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/Image.h>

#include "datmo_fusion/common/options.h"

namespace datmo {

struct ExposureCheckOptions {
  double min_contrast = 2.0;  ///< gray levels

  void visit(OptionVisitor& visitor);
};

/// Checks whether a camera's images show anything, and whether each is new.
class ExposureCheck {
 public:
  explicit ExposureCheck(const ExposureCheckOptions& options) : options_(options) {}

  /// Throws InputError: `blank_image` (black, white, covered), `half_image` (a quarter of its
  /// height or more is uniformly gray, and neither black nor sky), `frozen_image` (the same pixels
  /// as the last image, which was exposed earlier), and errors of grayOrColor.
  void check(const sensor_msgs::ImageConstPtr& image) const;

  /// Reports that the image was accepted: the next one is compared with it.
  void accept(const sensor_msgs::ImageConstPtr& image) { last_ = image; }

  void reset() { last_.reset(); }

 private:
  ExposureCheckOptions options_;
  sensor_msgs::ImageConstPtr last_;
};

}  // namespace datmo
