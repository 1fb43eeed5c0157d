// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "datmo_fusion/vision/image_detector.h"

namespace datmo {

/// What a network is trained to see, as far as it matters for road users.
enum class NetworkLabel { kOther, kPerson, kCycle, kVehicle };

/// By a name of the COCO data set (Lin et al. 2014); "bicycle" and "motorcycle" are cycles, "car",
/// "bus", "truck" and "train" vehicles.
NetworkLabel labelOf(const std::string& coco_name);

/// One thing that a network sees.
struct NetworkDetection {
  Eigen::AlignedBox2d box;  ///< px of the network's input
  NetworkLabel label = NetworkLabel::kOther;
  double score = 0.0;  ///< 0 to 1
};

/// A network's output as rows of numbers: x, y, width, height, that there is anything, and a score
/// for each of its labels.
struct NetworkOutput {
  const float* data = nullptr;
  int rows = 0;
  int columns = 0;  ///< 5 and the number of labels
};

/// Size of a network's input, px.
struct NetworkSize {
  int width = 0;
  int height = 0;
};

/// Decodes a YOLO layer of Darknet as cv::dnn returns it: center and size relative to the input,
/// class scores already times that there is anything. Things of less than `min_score`, and others
/// than road users, are left out, and so are rows that are not finite.
///
/// Throws std::runtime_error for an output of other columns than the labels ask for.
std::vector<NetworkDetection> decodeYolo(const NetworkOutput& output, const NetworkSize& input,
                                         const std::vector<NetworkLabel>& labels, double min_score);

/// Decodes the output of YOLOX (Ge et al. 2021): offsets to the cells of grids of 8, 16 and 32 px,
/// logarithms of sizes in cells. Otherwise as decodeYolo; throws as well where rows and grids do
/// not match.
std::vector<NetworkDetection> decodeYolox(const NetworkOutput& output, const NetworkSize& input,
                                          const std::vector<NetworkLabel>& labels,
                                          double min_score);

/// Persons, riders and vehicles: a person on a cycle (beside each other by most of the narrower
/// one's width, the feet within the cycle's height) is a cyclist of both rectangles, its score the
/// geometric mean. Cycles without a rider are no road users and left out. Of a class each
/// thing comes once (withoutDuplicates).
std::vector<ImageDetection> roadUsers(const std::vector<NetworkDetection>& things,
                                      double max_overlap);

}  // namespace datmo
