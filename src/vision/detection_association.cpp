// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/vision/detection_association.h"

#include <algorithm>
#include <cmath>

#include "datmo_fusion/assignment/assignment.h"
#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/common/square.h"

namespace datmo {

namespace {

/// Result of comparing an object and a detection.
struct Pairing {
  double coverage = 0.0;  ///< 0 to 1, of the object's columns
  double score = 0.0;     ///< log-likelihood ratio of "one" against "two"
};

/// Maximum share of the object's columns that lie within the detection's, over shifts within the
/// object's uncertainty.
double coverageOf(const ImageRegion& object, const Eigen::AlignedBox2d& detection) {
  const double slack_left = object.box.min().x() - object.search.min().x();
  const double slack_right = object.search.max().x() - object.box.max().x();
  const double from = std::max(object.box.min().x(), detection.min().x() - slack_right);
  const double to = std::min(object.box.max().x(), detection.max().x() + slack_left);
  return std::clamp((to - from) / object.box.sizes().x(), 0.0, 1.0);
}

/// None if they cannot be the same.
std::optional<Pairing> pairingOf(const ProjectedObject& object, const ImageDetection& detection,
                                 const std::optional<ImageRange>& range,
                                 const DetectionAssociationOptions& options) {
  Pairing pair;
  pair.coverage = coverageOf(object.region, detection.box);
  if (pair.coverage < options.min_coverage) {
    return std::nullopt;
  }
  // Without a range, if cut by the image's border, the columns decide.
  if (range) {
    const double sigma = std::hypot(range->sigma / range->range, object.range_sigma / object.range);
    const double squared = square(std::log(range->range / object.range) / sigma);
    if (squared > options.range_gate) {
      return std::nullopt;
    }
    pair.score = -0.5 * squared - std::log(sigma * std::sqrt(kTurn) * options.unrelated_density);
  }
  const double width = detection.box.sizes().x();
  const double slack = 0.5 * (object.region.search.sizes().x() - object.region.box.sizes().x());
  const double apart = object.region.box.center().x() - detection.box.center().x();
  pair.score -= 0.5 * square(apart / std::hypot(options.column_share * width, slack));
  return pair;
}

}  // namespace

void DetectionAssociationOptions::visit(OptionVisitor& visitor) {
  visitor.number({"unrelated_density", "1",
                  "density of unrelated objects at the same columns, per factor e of range: a "
                  "detection and an object must be a likelier pair than one of them"},
                 unrelated_density, {1e-6, 100.0});
}

std::vector<std::optional<std::size_t>> associate(const std::vector<ProjectedObject>& objects,
                                                  const std::vector<ImageDetection>& detections,
                                                  const MountedCamera& camera,
                                                  const ImageRangeOptions& range,
                                                  const DetectionAssociationOptions& options) {
  const auto rows = static_cast<Eigen::Index>(objects.size());
  const auto columns = static_cast<Eigen::Index>(detections.size());
  CostMatrix cost = CostMatrix::Constant(rows, columns, kForbidden);
  CostMatrix piece_cost = cost;
  for (Eigen::Index column = 0; column < columns; ++column) {
    const ImageDetection& detection = detections[static_cast<std::size_t>(column)];
    const auto detected_range = rangeOf(camera, detection, range);
    for (Eigen::Index row = 0; row < rows; ++row) {
      const auto pair =
          pairingOf(objects[static_cast<std::size_t>(row)], detection, detected_range, options);
      if (!pair) {
        continue;
      }
      cost(row, column) = -pair->score;
      if (detection.object_class == ObjectClass::kVehicle &&
          pair->coverage >= options.piece_coverage) {
        piece_cost(row, column) = -pair->score;
      }
    }
  }
  const std::vector<int> best = solveAssignment(cost, Eigen::VectorXd::Zero(rows)).column_of_row;
  std::vector<std::optional<std::size_t>> result(objects.size());
  for (Eigen::Index row = 0; row < rows; ++row) {
    const int own = best[static_cast<std::size_t>(row)];
    Eigen::Index column = own;
    if (own == kUnassigned &&
        (columns == 0 || piece_cost.row(row).minCoeff(&column) == kForbidden)) {
      continue;
    }
    result[static_cast<std::size_t>(row)] = static_cast<std::size_t>(column);
  }
  return result;
}

}  // namespace datmo
