// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/surface_texture.h"

#include <cmath>

namespace datmo::simulator {

namespace {

/// Cubes are offset from the centers and edges of solids, where rounding would switch between two
/// cubes.
constexpr double kOffset = 0.137;

/// SplitMix64's finalizer (Steele, Lea, Flood, "Fast splittable pseudorandom number generators",
/// 2014): each bit of the result depends on each bit of the value.
std::uint64_t mixed(std::uint64_t value) {
  value += 0x9e3779b97f4a7c15ULL;
  value = (value ^ (value >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  value = (value ^ (value >> 27U)) * 0x94d049bb133111ebULL;
  return value ^ (value >> 31U);
}

/// Uniform in [0, 1).
double toShare(std::uint64_t hash) {
  constexpr unsigned kUnusedBits = 11;  // a double's mantissa holds 53 of the 64 bits
  return std::ldexp(static_cast<double>(hash >> kUnusedBits), -53);
}

/// The point in the solid's own frame.
Point2 inFrameOf(const Solid& solid, const Point2& point) {
  if (const auto* box = std::get_if<Box2>(&solid.outline)) {
    return box->center.inverse() * point;
  }
  if (const auto* circle = std::get_if<Circle>(&solid.outline)) {
    return point - circle->center;
  }
  return point;
}

}  // namespace

SurfaceTexture::SurfaceTexture(double patch, double share_on_solids, double share_on_road,
                               std::uint64_t seed)
    : patch_(patch),
      share_on_solids_(share_on_solids),
      share_on_road_(share_on_road),
      seed_(seed) {}

bool SurfaceTexture::isEven(const RayEnd& end, const Point2& point) const {
  const Point2 position = end.solid != nullptr ? inFrameOf(*end.solid, point) : point;
  std::uint64_t hash = mixed(seed_ ^ (end.solid != nullptr ? end.solid->object : kNoObject));
  for (const double coordinate : {position.x(), position.y(), end.height}) {
    const auto index = static_cast<std::int64_t>(std::floor((coordinate + kOffset) / patch_));
    hash = mixed(hash ^ static_cast<std::uint64_t>(index));
  }
  return toShare(hash) < (end.solid != nullptr ? share_on_solids_ : share_on_road_);
}

}  // namespace datmo::simulator
