// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "stereo_surfaces.h"

namespace datmo {

/// Indices of surfaces that belong together, by column.
using SurfaceGroup = std::vector<std::size_t>;

/// What one object shows of itself bulges toward the camera; where a group has a dent, another
/// object begins: a parked car beside a cyclist, a house behind a car.
class DentSplitter {
 public:
  /// What is passed must outlive this.
  DentSplitter(const SurfaceColumns& columns, const StereoCamera& camera);

  /// Adds the parts of a group to `parts`, left ones first.
  void split(SurfaceGroup group, std::vector<SurfaceGroup>& parts);

 private:
  /// In these coordinates straight walls are straight lines.
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
