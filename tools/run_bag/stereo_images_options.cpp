// SPDX-License-Identifier: BSD-3-Clause
#include "stereo_images_options.h"

namespace datmo {

namespace {

void visitPrefilter(OptionVisitor& visitor, StereoImagesOptions& options) {
  visitor.integer({"prefilter_size", "px",
                   "side of the window over which block matching normalizes brightness; odd"},
                  options.prefilter_size, {5, 255});
  visitor.integer({"prefilter_cap", "1", "bound of the prefiltered values"}, options.prefilter_cap,
                  {1, 63});
}

void visitPostfilter(OptionVisitor& visitor, StereoImagesOptions& options) {
  visitor.number({"uniqueness_ratio", "percent",
                  "margin by which the best match must be better than the second best"},
                 options.uniqueness_ratio, {0, 100});
  visitor.integer(
      {"texture_threshold", "1", "block matching: windows of less texture are left out"},
      options.texture_threshold, {0, 10000});
  visitor.integer({"speckle_size", "px", "patches of fewer pixels are left out"},
                  options.speckle_size, {0, 1000});
  visitor.integer({"speckle_range", "px", "disparities within a patch differ by no more"},
                  options.speckle_range, {0, 31});
}

void visitSemiGlobal(OptionVisitor& visitor, StereoImagesOptions& options) {
  visitor.integer({"fullDP", "1", "semi-global matching: 1: in eight directions, slow; 0: in five"},
                  options.full_dp, {0, 1});
  visitor.number({"P1", "1", "semi-global matching: penalty for a disparity that changes by 1 px"},
                 options.small_change_price, {0, 4000});
  visitor.number({"P2", "1", "semi-global matching: penalty for one that changes by more"},
                 options.large_change_price, {0, 4000});
  visitor.integer(
      {"disp12MaxDiff", "px",
       "semi-global matching: maximum difference of the matches from left and from right"},
      options.left_right_difference, {0, 128});
}

}  // namespace

void StereoImagesOptions::visit(OptionVisitor& visitor) {
  visitor.toggle({"rectified", "", "the images are rectified, as stated by their source"},
                 rectified);
  sync.visit(visitor);
  visitor.integer({"stereo_algorithm", "1",
                   "0: block matching, 1: semi-global block matching (Hirschmueller 2008)"},
                  stereo_algorithm, {0, 1});
  visitPrefilter(visitor, *this);
  visitor.integer({"correlation_window_size", "px", "side of the windows that are matched; odd"},
                  correlation_window_size, {5, 255});
  visitor.integer({"min_disparity", "px", "minimum disparity"}, min_disparity, {-2048, 2048});
  visitor.integer({"disparity_range", "px", "disparities that are searched; a multiple of 16"},
                  disparity_range, {32, 4096});
  visitPostfilter(visitor, *this);
  visitSemiGlobal(visitor, *this);
}

}  // namespace datmo
