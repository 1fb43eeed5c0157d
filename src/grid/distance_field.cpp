// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/grid/distance_field.h"

#include <algorithm>

#include <opencv2/imgproc.hpp>

namespace datmo {

DistanceField::DistanceField(const GridWindow& window,
                             const std::function<bool(CellIndex)>& is_target, double outside)
    : window_(window), outside_(outside) {
  cv::Mat others(window_.rows, window_.columns, CV_8UC1);
  for (int row = 0; row < window_.rows; ++row) {
    for (int column = 0; column < window_.columns; ++column) {
      const CellIndex cell{window_.corner.column + column, window_.corner.row + row};
      others.at<unsigned char>(row, column) = is_target(cell) ? 0 : 255;
    }
  }
  cv::Mat cells;
  cv::distanceTransform(others, cells, cv::DIST_L2, cv::DIST_MASK_PRECISE, CV_32F);
  distances_.reserve(rowMajorSize(window_.columns, window_.rows));
  for (int row = 0; row < window_.rows; ++row) {
    for (int column = 0; column < window_.columns; ++column) {
      const double distance = window_.cell_size * static_cast<double>(cells.at<float>(row, column));
      distances_.push_back(static_cast<float>(distance));
    }
  }
}

}  // namespace datmo
