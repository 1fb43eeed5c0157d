// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "datmo_fusion/vision/image_detector.h"

namespace datmo {

/// A network's labels, as far as they matter for road users.
enum class NetworkLabel { kOther, kPerson, kCycle, kVehicle };

/// Converts a label of the COCO data set (Lin et al. 2014); "bicycle" and "motorcycle" are cycles,
/// "car", "bus", "truck" and "train" vehicles.
NetworkLabel labelOf(const std::string& coco_name);

/// COCO's 80 labels, of which road users are among the first.
std::vector<NetworkLabel> cocoLabels();

/// One detection of a network.
struct NetworkDetection {
  Eigen::AlignedBox2d box;  ///< px of the network's input
  NetworkLabel label = NetworkLabel::kOther;
  double score = 0.0;  ///< 0 to 1
};

/// A network's output as rows of numbers: x, y, width, height, objectness, and a score for each of
/// its labels.
struct NetworkOutput {
  const float* data = nullptr;
  int rows = 0;
  int columns = 0;  ///< 5 plus the number of labels
};

/// Size of a network's input, px.
struct NetworkSize {
  int width = 0;
  int height = 0;
};

/// Decodes a YOLO layer of Darknet as cv::dnn returns it: center and size relative to the input,
/// class scores already multiplied by objectness. Detections below `min_score`, of other classes
/// than road users, and with non-finite values are dropped.
///
/// Throws std::runtime_error if the number of columns does not match the labels.
std::vector<NetworkDetection> decodeYolo(const NetworkOutput& output, const NetworkSize& input,
                                         const std::vector<NetworkLabel>& labels, double min_score);

/// Decodes the output of YOLOX (Ge et al. 2021): offsets to the cells of grids of 8, 16 and 32 px,
/// logarithms of sizes in cells. Otherwise like decodeYolo; also throws if the number of rows does
/// not match the grids.
std::vector<NetworkDetection> decodeYolox(const NetworkOutput& output, const NetworkSize& input,
                                          const std::vector<NetworkLabel>& labels,
                                          double min_score);

/// Converts detections to persons, riders and vehicles: a person on a cycle (horizontal overlap of
/// most of the narrower one's width, the feet within the cycle's height) becomes a cyclist with
/// both rectangles and the geometric mean of the scores. Cycles without a rider are dropped.
/// Duplicates of a class are removed (withoutDuplicates).
std::vector<ImageDetection> roadUsers(const std::vector<NetworkDetection>& things,
                                      double max_overlap);

}  // namespace datmo
