// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "datmo_fusion/sensor_model/stereo_cloud.h"

namespace datmo {

/// Divides the depth ahead of a camera into bins as fine as its resolution: half a standard
/// deviation of the depth (for a stereo camera, uniform in disparity: Badino et al. 2007), but no
/// finer than the cells need.
class DepthBins {
 public:
  DepthBins() = default;
  /// Bins from the camera to `farthest`, each at least `finest` long. m, both above 0.
  DepthBins(const StereoCamera& camera, double farthest, double finest);

  int size() const { return static_cast<int>(middles_.size()); }

  /// Returns where the last bin ends, m.
  float farthest() const { return farthest_; }

  /// Returns the middle of a bin, m.
  float middle(int bin) const { return middles_[static_cast<std::size_t>(bin)]; }

  bool contains(float depth) const { return depth >= 0.0F && depth < farthest_; }

  /// Returns the bin of a depth, for which contains() must be true.
  int at(float depth) const { return bin_at_[indexOf(depth)]; }

  /// Returns the number of bins whose middle is nearer than this depth (0 or more; NaN: all).
  int before(float depth) const { return depth < farthest_ ? before_[indexOf(depth)] : size(); }

 private:
  std::size_t indexOf(float depth) const {
    return static_cast<std::size_t>(depth * bins_per_meter_);
  }

  float farthest_ = 0.0F;
  float bins_per_meter_ = 0.0F;
  std::vector<float> middles_;
  std::vector<int> bin_at_;  ///< by depth, in halves of the finest bin
  std::vector<int> before_;
};

}  // namespace datmo
