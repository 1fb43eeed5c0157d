// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/grid/hit_distribution.h"

#include <algorithm>

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

void CellHits::add(const CellHits& hits, const Eigen::Matrix2f& rotation,
                   const Eigen::Vector2f& shift, float max) {
  const Eigen::Vector2f turned = rotation * hits.sum;
  Eigen::Matrix2f products;
  products << hits.squares[0], hits.squares[1], hits.squares[1], hits.squares[2];
  products = (rotation * products * rotation.transpose() + turned * shift.transpose() +
              shift * turned.transpose() + hits.count * shift * shift.transpose())
                 .eval();
  count += hits.count;
  sum += turned + hits.count * shift;
  squares += Eigen::Vector3f(products(0, 0), products(0, 1), products(1, 1));
  const float keep = std::min(1.0F, max / std::max(count, 1.0F));
  count *= keep;
  sum *= keep;
  squares *= keep;
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
