// SPDX-License-Identifier: BSD-3-Clause
#include "heading_search.h"

#include <algorithm>
#include <cmath>

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/common/square.h"

namespace datmo {

namespace {

/// Squared distances in standard deviations, each bounded (Geman & McClure 1985). A second side is
/// an additional parameter: it must explain more than by chance (Schwarz 1978).
double costOf(const Points& points, double heading, double variance, double correlated_points) {
  const Axes axes(heading);
  const NearSides sides = extentOf(points, axes).nearSides();
  double cost = 0.0;
  Point2 farthest = Point2::Zero();  // for each side
  for (const Point2& point : points) {
    const Point2 distances = (axes(point) - sides.position).cwiseAbs();
    farthest = farthest.cwiseMax(distances);
    const double nearest = distances.minCoeff();
    const double distance2 = square(nearest);
    cost += distance2 / (variance + distance2 / kMaxCost);
  }
  const bool both = farthest.minCoeff() > kOnLine * std::sqrt(variance);
  cost /= correlated_points;
  const double independent = static_cast<double>(points.size()) / correlated_points;
  return both ? cost + std::log(std::max(1.0, independent)) : cost;
}

}  // namespace

HeadingSearch::HeadingSearch(const Points& points, const PointNoise& noise) {
  const Extent extent = extentOf(points, Axes(0.0));
  // The best of the tested headings is up to half a step off.
  const double slant = 0.25 * heading(1) * (extent.max - extent.min).norm();
  for (std::size_t i = 0; i < kHeadings; ++i) {
    costs_[i] =
        costOf(points, heading(i), square(noise.sigma) + slant * slant, noise.correlated_points);
  }
  best_ = static_cast<std::size_t>(std::min_element(costs_.begin(), costs_.end()) - costs_.begin());
}

double HeadingSearch::spreadAbout(double center) const {
  double sum = 0.0;
  double total = 0.0;
  for (std::size_t i = 0; i < kHeadings; ++i) {
    const double weight = std::exp(0.5 * (costs_[best_] - costs_[i]));
    const double apart =
        std::max(0.0, std::abs(std::remainder(heading(i) - center, kQuarterTurn)) - heading(1));
    sum += weight * apart * apart;
    total += weight;
  }
  return sum / total;
}

double HeadingSearch::heading(std::size_t i) {
  return kQuarterTurn * static_cast<double>(i) / static_cast<double>(kHeadings);
}

}  // namespace datmo
