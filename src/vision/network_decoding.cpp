// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/vision/network_decoding.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <stdexcept>
#include <utility>

namespace datmo {

namespace {

constexpr std::size_t kBoxColumns = 5;  ///< of an output's row: x, y, width, height, anything

/// A row of an output: its box in px and the most certain road user.
struct Row {
  const float* values = nullptr;

  double operator[](std::size_t column) const { return static_cast<double>(values[column]); }

  /// The best label, with scores multiplied by `share`.
  std::pair<NetworkLabel, double> best(const std::vector<NetworkLabel>& labels,
                                       double share) const {
    std::pair<NetworkLabel, double> result{NetworkLabel::kOther, 0.0};
    for (std::size_t i = 0; i < labels.size(); ++i) {
      const double score = share * (*this)[kBoxColumns + i];
      if (score > result.second) {
        result = {labels[i], score};
      }
    }
    return result;
  }
};

Eigen::AlignedBox2d boxOf(double x, double y, double width, double height) {
  const Eigen::Vector2d center(x, y);
  const Eigen::Vector2d half(0.5 * width, 0.5 * height);
  return {center - half, center + half};
}

void checkColumns(const NetworkOutput& output, const std::vector<NetworkLabel>& labels) {
  const int expected = static_cast<int>(kBoxColumns + labels.size());
  if (output.data == nullptr || output.columns != expected) {
    throw std::runtime_error("network's output of " + std::to_string(output.columns) +
                             " columns: expected " + std::to_string(expected) +
                             ", a rectangle, its confidence and a score for each of " +
                             std::to_string(labels.size()) + " labels");
  }
}

void addIfUser(const Eigen::AlignedBox2d& box, const std::pair<NetworkLabel, double>& best,
               double min_score, std::vector<NetworkDetection>& result) {
  const bool is_finite = box.min().allFinite() && box.max().allFinite();
  if (best.first != NetworkLabel::kOther && best.second >= min_score && is_finite &&
      !box.isEmpty()) {
    result.push_back({box, best.first, best.second});
  }
}

/// Whether a person rides a cycle.
bool rides(const Eigen::AlignedBox2d& person, const Eigen::AlignedBox2d& cycle) {
  constexpr double kBeside = 0.5;  // of the narrower one's width
  constexpr double kBelow = 0.25;  // of the cycle's height: feet below its rectangle
  const double common =
      std::min(person.max().x(), cycle.max().x()) - std::max(person.min().x(), cycle.min().x());
  const double narrower = std::min(person.sizes().x(), cycle.sizes().x());
  const double feet = person.max().y();
  return common >= kBeside * narrower && feet >= cycle.min().y() &&
         feet <= cycle.max().y() + kBelow * cycle.sizes().y() && person.min().y() < cycle.min().y();
}

std::vector<NetworkDetection> ofLabel(const std::vector<NetworkDetection>& things,
                                      NetworkLabel label) {
  std::vector<NetworkDetection> result;
  std::copy_if(things.begin(), things.end(), std::back_inserter(result),
               [label](const NetworkDetection& one) { return one.label == label; });
  return result;
}

/// The most certain cycle that the person rides; null: none.
const NetworkDetection* cycleOf(const NetworkDetection& person,
                                const std::vector<NetworkDetection>& cycles) {
  const NetworkDetection* best = nullptr;
  for (const NetworkDetection& cycle : cycles) {
    if (rides(person.box, cycle.box) && (best == nullptr || cycle.score > best->score)) {
      best = &cycle;
    }
  }
  return best;
}

}  // namespace

NetworkLabel labelOf(const std::string& coco_name) {
  static const std::vector<std::pair<const char*, NetworkLabel>> labels = {
      {"person", NetworkLabel::kPerson},    {"bicycle", NetworkLabel::kCycle},
      {"motorcycle", NetworkLabel::kCycle}, {"motorbike", NetworkLabel::kCycle},
      {"car", NetworkLabel::kVehicle},      {"bus", NetworkLabel::kVehicle},
      {"truck", NetworkLabel::kVehicle},    {"train", NetworkLabel::kVehicle}};
  const auto found = std::find_if(labels.begin(), labels.end(),
                                  [&coco_name](const auto& one) { return one.first == coco_name; });
  return found == labels.end() ? NetworkLabel::kOther : found->second;
}

std::vector<NetworkLabel> cocoLabels() {
  std::vector<NetworkLabel> labels(80, NetworkLabel::kOther);
  const std::vector<std::string> first = {"person",   "bicycle", "car",   "motorcycle",
                                          "airplane", "bus",     "train", "truck"};
  std::transform(first.begin(), first.end(), labels.begin(), labelOf);
  return labels;
}

std::vector<NetworkDetection> decodeYolo(const NetworkOutput& output, const NetworkSize& input,
                                         const std::vector<NetworkLabel>& labels,
                                         double min_score) {
  checkColumns(output, labels);
  std::vector<NetworkDetection> result;
  for (int i = 0; i < output.rows; ++i) {
    const Row row{output.data + static_cast<std::ptrdiff_t>(i) * output.columns};
    addIfUser(boxOf(row[0] * input.width, row[1] * input.height, row[2] * input.width,
                    row[3] * input.height),
              row.best(labels, 1.0), min_score, result);
  }
  return result;
}

std::vector<NetworkDetection> decodeYolox(const NetworkOutput& output, const NetworkSize& input,
                                          const std::vector<NetworkLabel>& labels,
                                          double min_score) {
  checkColumns(output, labels);
  constexpr std::array<int, 3> kStrides = {8, 16, 32};
  int cells = 0;
  for (const int stride : kStrides) {
    cells += (input.width / stride) * (input.height / stride);
  }
  if (cells != output.rows) {
    throw std::runtime_error("network's output of " + std::to_string(output.rows) +
                             " rows: expected " + std::to_string(cells) + ", the cells of 8, 16 " +
                             "and 32 px of an input of " + std::to_string(input.width) + " x " +
                             std::to_string(input.height) + " px");
  }
  std::vector<NetworkDetection> result;
  Row row{output.data};
  for (const int stride : kStrides) {
    for (int y = 0; y < input.height / stride; ++y) {
      for (int x = 0; x < input.width / stride; ++x, row.values += output.columns) {
        addIfUser(boxOf((row[0] + x) * stride, (row[1] + y) * stride, std::exp(row[2]) * stride,
                        std::exp(row[3]) * stride),
                  row.best(labels, row[4]), min_score, result);
      }
    }
  }
  return result;
}

std::vector<ImageDetection> roadUsers(const std::vector<NetworkDetection>& things,
                                      double max_overlap) {
  std::vector<ImageDetection> users;
  const std::vector<NetworkDetection> cycles = ofLabel(things, NetworkLabel::kCycle);
  for (const NetworkDetection& person : ofLabel(things, NetworkLabel::kPerson)) {
    if (const NetworkDetection* cycle = cycleOf(person, cycles)) {
      users.push_back({person.box.merged(cycle->box), ObjectClass::kCyclist,
                       std::sqrt(person.score * cycle->score)});
    } else {
      users.push_back({person.box, ObjectClass::kPedestrian, person.score});
    }
  }
  for (const NetworkDetection& vehicle : ofLabel(things, NetworkLabel::kVehicle)) {
    users.push_back({vehicle.box, ObjectClass::kVehicle, vehicle.score});
  }
  return withoutDuplicates(std::move(users), max_overlap);
}

}  // namespace datmo
