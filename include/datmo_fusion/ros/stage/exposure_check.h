// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/Image.h>

#include "datmo_fusion/common/options.h"

namespace datmo {

struct ExposureCheckOptions {
  double min_contrast = 2.0;  ///< gray levels

  void visit(OptionVisitor& visitor);
};

/// Whether a camera's images show anything, and each something new.
class ExposureCheck {
 public:
  explicit ExposureCheck(const ExposureCheckOptions& options) : options_(options) {}

  /// Throws InputError: `blank_image` (black, white, covered), `half_image` (a quarter of its
  /// height or more is of one gray, and neither black nor sky), `frozen_image` (the same pixels as
  /// the last one's, which was exposed earlier), and as grayOrColor does.
  void check(const sensor_msgs::ImageConstPtr& image) const;

  /// The image has been accepted: the next one is compared with it.
  void accept(const sensor_msgs::ImageConstPtr& image) { last_ = image; }

  void reset() { last_.reset(); }

 private:
  ExposureCheckOptions options_;
  sensor_msgs::ImageConstPtr last_;
};

}  // namespace datmo
