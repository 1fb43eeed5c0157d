// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "tracking_scene.h"

namespace datmo {

struct RandomSceneOptions {
  int targets = 6;
  double range = 20.0;      ///< m, of the square about the origin in which they start
  double speed_std = 3.0;   ///< m/s, of each component
  double detection = 0.85;  ///< 1
  double noise_std = 0.15;  ///< m
  int max_clutter = 5;      ///< false objects in one scan
};

/// Objects that move straight across each other, missed at times, among false objects; seeded.
class RandomScene {
 public:
  RandomScene(std::uint64_t seed, const RandomSceneOptions& options)
      : options_(options), engine_(seed) {
    for (int i = 0; i < options.targets; ++i) {
      positions_.emplace_back(uniform(), uniform());
      velocities_.emplace_back(options.speed_std * normal(), options.speed_std * normal());
    }
  }

  /// Returns the objects 0.1 s later.
  std::vector<Object> next() {
    std::vector<Object> objects;
    for (std::size_t i = 0; i < positions_.size(); ++i) {
      positions_[i] += 0.1 * velocities_[i];
      const double luck = std::uniform_real_distribution<double>()(engine_);
      const Point2 noise = options_.noise_std * Point2(normal(), normal());
      if (luck < options_.detection) {
        objects.push_back(objectAt(positions_[i].x() + noise.x(), positions_[i].y() + noise.y()));
      }
    }
    const int clutter = std::uniform_int_distribution<int>(0, options_.max_clutter)(engine_);
    for (int i = 0; i < clutter; ++i) {
      const double x = uniform();
      objects.push_back(objectAt(x, uniform()));
    }
    return objects;
  }

 private:
  double normal() { return std::normal_distribution<double>()(engine_); }
  double uniform() {
    return std::uniform_real_distribution<double>(-options_.range, options_.range)(engine_);
  }

  RandomSceneOptions options_;
  std::mt19937_64 engine_;
  std::vector<Point2> positions_;
  std::vector<Point2> velocities_;
};

}  // namespace datmo
