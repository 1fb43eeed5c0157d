// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "stereo_surfaces.h"

namespace datmo {

/// Indices of surfaces that belong together, by column.
using SurfaceGroup = std::vector<std::size_t>;

/// The visible outline of one object is convex toward the camera; at a dent in a group, another
/// object begins: a parked car next to a cyclist, a house behind a car.
class DentSplitter {
 public:
  /// The arguments must outlive this object.
  DentSplitter(const SurfaceColumns& columns, const StereoCamera& camera);

  /// Appends the parts of a group to `parts`, from left to right.
  void split(SurfaceGroup group, std::vector<SurfaceGroup>& parts);

 private:
  /// A point in coordinates in which straight walls are straight lines.
  struct ProfilePoint {
    int column;
    double inverse;  ///< 1/m: of the depth of the nearest surface in the column
  };

  void profileOf(const SurfaceGroup& group);
  void hullOfProfile();
  std::optional<int> dent() const;
  double above(std::size_t first, std::size_t middle, std::size_t last) const;

  const SurfaceColumns& columns_;
  DepthNoise noise_;
  std::vector<ProfilePoint> profile_;
  std::vector<ProfilePoint> raw_profile_;
  std::vector<std::size_t> hull_;  ///< indices of the profile
};

}  // namespace datmo
