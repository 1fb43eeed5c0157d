// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "datmo_fusion/risk/host_motion.h"

namespace datmo {

/// Stationary obstacles that are not tracks: end points of beams, thinned out and ordered so that
/// those near a moving body are found quickly.
class StandingPoints {
 public:
  /// `points`: m, fixed frame; those that are not finite are ignored. `spacing`: m, more than 0: of
  /// several in a cell of this size, the first is kept.
  StandingPoints(const std::vector<Point2>& points, double spacing);

  struct Contact {
    double time = 0.0;  ///< s
    Point2 point = Point2::Zero();
  };

  /// Returns the first point that a body touches on its path; none if it touches none.
  std::optional<Contact> firstContact(const BodyPath& path, const BodySize& size) const;

  std::size_t size() const { return points_.size(); }

 private:
  void checkMove(const BodyMove& move, double start, double step,
                 std::optional<Contact>& first) const;

  std::vector<Point2> points_;  ///< by ascending x
};

}  // namespace datmo
