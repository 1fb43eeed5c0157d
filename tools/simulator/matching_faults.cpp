// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/matching_faults.h"

#include <algorithm>
#include <cmath>

namespace datmo::simulator {

namespace {

/// Disparities that differ by more (px) belong to two surfaces: the usual limit of the left-right
/// check.
constexpr double kSameSurface = 1.0;

/// The right camera's view of one row: the greatest disparity in each of its columns.
class RightRow {
 public:
  RightRow(int columns, int column_step)
      : step_(column_step), disparity_(static_cast<std::size_t>(columns * column_step), 0.0) {}

  void clear() { std::fill(disparity_.begin(), disparity_.end(), 0.0); }

  /// A pixel of the left image, as wide as the step.
  void add(int column, double disparity) {
    const int first = columnOf(column, disparity);
    for (int i = std::max(0, first); i < std::min(size(), first + step_); ++i) {
      double& nearest = disparity_[static_cast<std::size_t>(i)];
      nearest = std::max(nearest, disparity);
    }
  }

  bool sees(int column, double disparity) const {
    const int at = columnOf(column, disparity);
    return at >= 0 && disparity_[static_cast<std::size_t>(at)] <= disparity + kSameSurface;
  }

 private:
  int size() const { return static_cast<int>(disparity_.size()); }
  int columnOf(int column, double disparity) const {
    return static_cast<int>(std::floor(column * step_ - disparity));
  }

  int step_;
  std::vector<double> disparity_;
};

/// Random values at the corners of square patches, interpolated between them; standard deviation 1
/// at each pixel.
class SmoothNoise {
 public:
  SmoothNoise(const DisparityImage& image, int patch, RandomStream& random)
      : patch_(patch), columns_(image.columns * image.column_step / patch + 2) {
    const int rows = image.rows * image.row_step / patch + 2;
    corners_.resize(rowMajorSize(columns_, rows));
    for (double& corner : corners_) {
      corner = random.normal(1.0);
    }
  }

  /// Of a pixel of the full image.
  double at(int column, int row) const {
    const int left = column / patch_;
    const int above = row / patch_;
    const double across = static_cast<double>(column % patch_) / patch_;
    const double down = static_cast<double>(row % patch_) / patch_;
    const double sum =
        (1.0 - down) * between(left, above, across) + down * between(left, above + 1, across);
    return sum / (deviation(across) * deviation(down));
  }

 private:
  double between(int left, int row, double across) const {
    const std::size_t first = rowMajorIndex(left, row, columns_);
    return (1.0 - across) * corners_[first] + across * corners_[first + 1];
  }
  /// Of a value between two independent ones of standard deviation 1.
  static double deviation(double share) {
    return std::sqrt((1.0 - share) * (1.0 - share) + share * share);
  }

  int patch_;
  int columns_;
  std::vector<double> corners_;
};

/// The nearest surface within `reach` columns beside a pixel, if it is another surface.
double nearerBeside(const DisparityImage& image, int column, int row, int reach) {
  const double own = image.seen[image.slot(column, row)];
  double nearest = own;
  const int last = std::min(image.columns - 1, column + reach);
  for (int other = std::max(0, column - reach); other <= last; ++other) {
    nearest = std::max(nearest, image.seen[image.slot(other, row)]);
  }
  return nearest > own + kSameSurface ? nearest : own;
}

}  // namespace

void removeHidden(DisparityImage& image) {
  RightRow right(image.columns, image.column_step);
  for (int row = 0; row < image.rows; ++row) {
    right.clear();
    for (int column = 0; column < image.columns; ++column) {
      right.add(column, image.seen[image.slot(column, row)]);
    }
    for (int column = 0; column < image.columns; ++column) {
      const std::size_t slot = image.slot(column, row);
      if (!right.sees(column, image.seen[slot])) {
        image.measured[slot] = kNoDisparity;
      }
    }
  }
}

void mixEdges(DisparityImage& image, int width, double probability, RandomStream& random) {
  const int reach = width / image.column_step;
  for (int row = 0; row < image.rows; ++row) {
    for (int column = 0; column < image.columns; ++column) {
      double& measured = image.measured[image.slot(column, row)];
      if (measured == kNoDisparity) {
        continue;
      }
      const double nearer = nearerBeside(image, column, row, reach);
      if (nearer > measured && random.chance(probability)) {
        measured += random.uniform() * (nearer - measured);
      }
    }
  }
}

void addNoise(DisparityImage& image, double sigma, double common_share, int patch,
              RandomStream& random) {
  const SmoothNoise common(image, patch, random);
  const double common_sigma = sigma * std::sqrt(common_share);
  const double own_sigma = sigma * std::sqrt(1.0 - common_share);
  for (int row = 0; row < image.rows; ++row) {
    for (int column = 0; column < image.columns; ++column) {
      double& measured = image.measured[image.slot(column, row)];
      if (measured != kNoDisparity) {
        const double shared = common.at(column * image.column_step, row * image.row_step);
        measured += common_sigma * shared + random.normal(own_sigma);
      }
    }
  }
}

void addOutliers(DisparityImage& image, double share, int patch, double min, double max,
                 RandomStream& random) {
  const int width = std::max(1, patch / image.column_step);
  const int height = std::max(1, patch / image.row_step);
  for (int top = 0; top < image.rows; top += height) {
    for (int left = 0; left < image.columns; left += width) {
      if (!random.chance(share)) {
        continue;
      }
      const double disparity = min + random.uniform() * (max - min);
      for (int row = top; row < std::min(image.rows, top + height); ++row) {
        for (int column = left; column < std::min(image.columns, left + width); ++column) {
          image.measured[image.slot(column, row)] = disparity;
        }
      }
    }
  }
}

}  // namespace datmo::simulator
