// SPDX-License-Identifier: BSD-3-Clause
#include "fused_sides.h"

#include <algorithm>
#include <cstddef>

#include <Eigen/Cholesky>

namespace datmo {

namespace {

/// m^2, added to the variance of each side: keeps the information finite.
constexpr double kMinSideVariance = 1e-8;

/// Selects the sides that were seen.
using SeenMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 4, 4>;

/// Sides that were not seen have no information.
struct SideEstimate {
  SideMatrix information = SideMatrix::Zero();
  SideVector weighted = SideVector::Zero();  ///< information times position
};

struct SeenSides {
  std::array<Eigen::Index, kBoxSides> index{};
  Eigen::Index count = 0;

  void add(Eigen::Index side) { index[static_cast<std::size_t>(count++)] = side; }
  Eigen::Index operator[](Eigen::Index i) const { return index[static_cast<std::size_t>(i)]; }
};

constexpr std::size_t axisOf(Eigen::Index side) { return static_cast<std::size_t>(side) / 2; }
constexpr std::size_t endOf(Eigen::Index side) { return static_cast<std::size_t>(side) % 2; }

/// 1 for sides across the same axis.
const SideMatrix kSameAxis = (SideMatrix() << 1, 1, 0, 0,  //
                              1, 1, 0, 0,                  //
                              0, 0, 1, 1,                  //
                              0, 0, 1, 1)
                                 .finished();

SeenMatrix inverse(const SeenMatrix& matrix) {
  return matrix.llt().solve(SeenMatrix::Identity(matrix.rows(), matrix.cols()));
}

SideEstimate estimateOf(const ObjectSides& sides) {
  SeenSides seen;
  for (Eigen::Index side = 0; side < 4; ++side) {
    if (sides.along[axisOf(side)].isSeen(endOf(side))) {
      seen.add(side);
    }
  }
  SeenMatrix covariance(seen.count, seen.count);
  for (Eigen::Index i = 0; i < seen.count; ++i) {
    for (Eigen::Index j = 0; j < seen.count; ++j) {
      covariance(i, j) = sides.covariance(static_cast<Eigen::Index>(axisOf(seen[i])),
                                          static_cast<Eigen::Index>(axisOf(seen[j])));
    }
    covariance(i, i) += sides.along[axisOf(seen[i])].variance[endOf(seen[i])] + kMinSideVariance;
  }
  const SeenMatrix information = inverse(covariance);
  SideEstimate estimate;
  for (Eigen::Index i = 0; i < seen.count; ++i) {
    for (Eigen::Index j = 0; j < seen.count; ++j) {
      estimate.information(seen[i], seen[j]) = information(i, j);
      estimate.weighted[seen[i]] +=
          information(i, j) * sides.along[axisOf(seen[j])].position[endOf(seen[j])];
    }
  }
  return estimate;
}

}  // namespace

FusedSides fusedSides(const ObjectSides& sides_a, const ObjectSides& sides_b) {
  const SideEstimate a = estimateOf(sides_a);
  const SideEstimate b = estimateOf(sides_b);
  const SideMatrix information = a.information + b.information;
  SeenSides seen;
  for (Eigen::Index side = 0; side < 4; ++side) {
    if (information(side, side) > 0.0) {
      seen.add(side);
    }
  }
  SeenMatrix of_seen(seen.count, seen.count);
  for (Eigen::Index i = 0; i < seen.count; ++i) {
    for (Eigen::Index j = 0; j < seen.count; ++j) {
      of_seen(i, j) = information(seen[i], seen[j]);
    }
  }
  const SeenMatrix covariance = inverse(of_seen);
  FusedSides result;
  for (Eigen::Index i = 0; i < seen.count; ++i) {
    result.seen[static_cast<std::size_t>(seen[i])] = true;
    for (Eigen::Index j = 0; j < seen.count; ++j) {
      result.covariance(seen[i], seen[j]) = covariance(i, j);
    }
  }
  result.position = result.covariance * (a.weighted + b.weighted);
  if (seen.count > 0) {
    const double moved = (result.covariance * b.information).cwiseProduct(kSameAxis).sum();
    result.weight_of_b = std::clamp(moved / static_cast<double>(seen.count), 0.0, 1.0);
  }
  return result;
}

}  // namespace datmo
