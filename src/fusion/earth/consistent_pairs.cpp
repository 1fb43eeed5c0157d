// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/earth/consistent_pairs.h"

#include <algorithm>
#include <cmath>

#include "datmo_fusion/common/cross.h"

namespace datmo {

namespace {

constexpr std::size_t kMinPairs = 2;
constexpr double kParameters = 3.0;  ///< parameters of the motion: x, y, heading

/// Weighted sums over pairs, from which a pair can be removed again.
class PairSums {
 public:
  void add(const PointPair& pair, double sign = 1.0) {
    const double weight = sign / pair.variance;
    weights_ += weight;
    a_ += weight * pair.a;
    b_ += weight * pair.b;
    squares_ += weight * (pair.a.squaredNorm() + pair.b.squaredNorm());
    along_ += weight * pair.a.dot(pair.b);
    across_ += weight * cross(pair.a, pair.b);
  }

  /// Minimum sum of squares of a rigid motion (Arun, Huang, Blostein 1987), without one pair.
  double costWithout(const PointPair& pair) const {
    PairSums rest = *this;
    rest.add(pair, -1.0);
    return rest.cost();
  }

  double cost() const {
    const double squares = squares_ - (a_.squaredNorm() + b_.squaredNorm()) / weights_;
    const double along = along_ - a_.dot(b_) / weights_;
    const double across = across_ - cross(a_, b_) / weights_;
    return std::max(squares - 2.0 * std::hypot(along, across), 0.0);
  }

 private:
  double weights_ = 0.0;
  Point2 a_ = Point2::Zero();
  Point2 b_ = Point2::Zero();
  double squares_ = 0.0;
  double along_ = 0.0;
  double across_ = 0.0;
};

}  // namespace

ConsistentPairs consistentPairs(const std::vector<PointPair>& pairs, double gate) {
  ConsistentPairs result{std::vector<bool>(pairs.size(), true), pairs.size(), 0.0};
  if (pairs.size() <= kMinPairs) {
    return result;
  }
  std::vector<PointPair> centered = pairs;  // squares of large coordinates lose digits
  PairSums sums;
  for (PointPair& pair : centered) {
    pair.a -= pairs.front().a;
    pair.b -= pairs.front().b;
    sums.add(pair);
  }
  while (result.count > kMinPairs) {
    std::size_t worst = pairs.size();
    double least = sums.cost() - gate;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      if (!result.fits[i]) {
        continue;
      }
      const double without = sums.costWithout(centered[i]);
      if (without < least) {
        least = without;
        worst = i;
      }
    }
    if (worst == pairs.size()) {
      break;
    }
    sums.add(centered[worst], -1.0);
    result.fits[worst] = false;
    --result.count;
  }
  const double freedom = 2.0 * static_cast<double>(result.count) - kParameters;
  result.variance_factor = sums.cost() / freedom;
  return result;
}

}  // namespace datmo
