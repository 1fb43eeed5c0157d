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

void HitSums::add(const CellHits& cell, const Point2& shift, double maturity) {
  const double count = cell.count;
  const Point2 offset = cell.sum.cast<double>();
  Eigen::Matrix2d own;
  own << cell.squares[0], cell.squares[1], cell.squares[1], cell.squares[2];
  hits_ += count;
  maturity_ += count * maturity;
  sum_ += offset + count * shift;
  squares_ += own + shift * offset.transpose() + offset * shift.transpose() +
              count * shift * shift.transpose();
}

HitDistribution HitSums::about(const Point2& reference) const {
  const Point2 mean = sum_ / hits_;
  return {hits_, reference + mean, squares_ / hits_ - mean * mean.transpose(), maturity_ / hits_};
}

}  // namespace datmo
