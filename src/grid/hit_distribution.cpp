// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/grid/hit_distribution.h"

namespace datmo {

void CellHits::add(const Eigen::Vector2f& offset, float max) {
  if (count >= max) {
    const float keep = (max - 1.0F) / count;
    count *= keep;
    sum *= keep;
    squares *= keep;
  }
  count += 1.0F;
  sum += offset;
  squares +=
      Eigen::Vector3f(offset.x() * offset.x(), offset.x() * offset.y(), offset.y() * offset.y());
}

void HitSums::add(const CellHits& cell, const Point2& shift, double maturity, double age) {
  const double count = cell.count;
  const Point2 offset = cell.sum.cast<double>();
  const Point2 moved = offset + count * shift;
  hits_ += count;
  maturity_ += count * maturity;
  age_ += count * age;
  sum_ += moved;
  squares_ +=
      cell.squares.cast<double>() + Eigen::Vector3d(shift.x() * (offset.x() + moved.x()),
                                                    shift.x() * offset.y() + shift.y() * moved.x(),
                                                    shift.y() * (offset.y() + moved.y()));
}

HitDistribution HitSums::about(const Point2& reference) const {
  const Point2 mean = sum_ / hits_;
  const Eigen::Vector3d squares = squares_ / hits_;
  Eigen::Matrix2d covariance;
  covariance << squares[0], squares[1], squares[1], squares[2];
  return {hits_, reference + mean, covariance - mean * mean.transpose(), maturity_ / hits_,
          age_ / hits_};
}

}  // namespace datmo
