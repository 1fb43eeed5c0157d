// SPDX-License-Identifier: BSD-3-Clause
#include "dent_splitter.h"

#include <algorithm>
#include <utility>

namespace datmo {

namespace {

/// m; a group with a deeper dent than this is split: the outline of a single object is convex.
constexpr double kDent = 1.0;

/// Minimum depth of the dent in standard deviations of the depth.
constexpr double kDentSigmas = 2.5;

}  // namespace

DentSplitter::DentSplitter(const SurfaceColumns& columns, const StereoCamera& camera)
    : columns_(columns), noise_(camera.noise) {}

void DentSplitter::split(SurfaceGroup group, std::vector<SurfaceGroup>& parts) {
  std::vector<SurfaceGroup> wholes{std::move(group)};
  while (!wholes.empty()) {
    SurfaceGroup whole = std::move(wholes.back());
    wholes.pop_back();
    profileOf(whole);
    hullOfProfile();
    const std::optional<int> column = dent();
    if (!column) {
      parts.push_back(std::move(whole));
      continue;
    }
    const auto first_right = std::find_if(whole.begin(), whole.end(), [&](std::size_t index) {
      return columns_.surfaces[index].column >= *column;
    });
    wholes.emplace_back(first_right, whole.end());
    wholes.emplace_back(whole.begin(), first_right);
  }
}

/// Computes the profile, smoothed over three columns.
void DentSplitter::profileOf(const SurfaceGroup& group) {
  raw_profile_.clear();
  for (const std::size_t index : group) {
    const ColumnSurface& surface = columns_.surfaces[index];
    if (raw_profile_.empty() || raw_profile_.back().column < surface.column) {
      raw_profile_.push_back({surface.column, 1.0 / static_cast<double>(surface.depth)});
    }
  }
  profile_ = raw_profile_;
  for (std::size_t i = 1; i + 1 < profile_.size(); ++i) {
    profile_[i].inverse =
        (raw_profile_[i - 1].inverse + raw_profile_[i].inverse + raw_profile_[i + 1].inverse) / 3.0;
  }
}

/// Computes the side of the convex hull that faces the camera (Andrew 1979).
void DentSplitter::hullOfProfile() {
  hull_.clear();
  for (std::size_t i = 0; i < profile_.size(); ++i) {
    while (hull_.size() >= 2 && above(hull_[hull_.size() - 2], hull_.back(), i) <= 0.0) {
      hull_.pop_back();
    }
    hull_.push_back(i);
  }
}

/// The column of the deepest dent in the hull that is deep enough.
std::optional<int> DentSplitter::dent() const {
  double deepest = 1.0;
  std::optional<int> column;
  for (std::size_t side = 0; side + 1 < hull_.size(); ++side) {
    for (std::size_t i = hull_[side] + 1; i < hull_[side + 1]; ++i) {
      const double inverse = profile_[i].inverse;
      const double min =
          std::max(kDentSigmas * noise_.inverseSigma(inverse), kDent * inverse * inverse);
      const double depth = -above(hull_[side], i, hull_[side + 1]) / min;
      if (depth > deepest) {
        deepest = depth;
        column = profile_[i].column;
      }
    }
  }
  return column;
}

/// 1/m, by how much the middle one of three points is nearer than the line through the others.
double DentSplitter::above(std::size_t first, std::size_t middle, std::size_t last) const {
  const ProfilePoint& a = profile_[first];
  const ProfilePoint& b = profile_[last];
  const ProfilePoint& between = profile_[middle];
  const double share = static_cast<double>(between.column - a.column) / (b.column - a.column);
  return between.inverse - (a.inverse + share * (b.inverse - a.inverse));
}

}  // namespace datmo
