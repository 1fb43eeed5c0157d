// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/ros/stage/stereo_pairs.h"

namespace datmo {

/// Options for computing disparities from two images: the parameters of the nodelet
/// stereo_image_proc/disparity under its own names and with its defaults and ranges, so that one
/// yaml section serves both.
struct StereoImagesOptions {
  bool rectified = true;  ///< false: the images are rectified by their calibration
  StereoSyncOptions sync;
  int stereo_algorithm = 0;  ///< 0: block matching, 1: semi-global block matching
  int prefilter_size = 9;    ///< px
  int prefilter_cap = 31;
  int correlation_window_size = 15;  ///< px
  int min_disparity = 0;             ///< px
  int disparity_range = 64;          ///< px
  double uniqueness_ratio = 15.0;    ///< percent
  int texture_threshold = 10;
  int speckle_size = 100;             ///< px
  int speckle_range = 4;              ///< px
  int full_dp = 0;                    ///< fullDP; 0 or 1
  double small_change_price = 200.0;  ///< P1
  double large_change_price = 400.0;  ///< P2
  int left_right_difference = 0;      ///< disp12MaxDiff, px

  void visit(OptionVisitor& visitor);
};

}  // namespace datmo
