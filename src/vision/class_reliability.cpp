// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/vision/class_reliability.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string>

namespace datmo {

namespace {

constexpr std::array<ObjectClass, 3> kReported = {ObjectClass::kPedestrian, ObjectClass::kCyclist,
                                                  ObjectClass::kVehicle};

/// Probability that a randomly chosen class is right.
constexpr double kChance = 1.0 / static_cast<double>(kObjectClasses);

}  // namespace

void ClassReliabilityOptions::visit(OptionVisitor& visitor) {
  visitor.numbers({"scores", "1", "reliability curve: scores of the detector, in rising order"},
                  scores, {-1e3, 1e3});
  visitor.numbers({"right", "1",
                   "share of the reports with this score whose class is right (written by "
                   "`evaluate calibrate_classes`)"},
                  right, {0.0, 1.0});
  visitor.numbers({"mistaken", "1",
                   "relative frequencies of what wrongly reported objects really are: rows "
                   "pedestrian, cyclist, vehicle as reported; columns unknown, pedestrian, "
                   "cyclist, vehicle, pole as they are"},
                  mistaken, {0.0, 1e9});
}

void ClassReliabilityOptions::check() const {
  if (scores.empty() || scores.size() != right.size()) {
    throw OptionError("scores of " + std::to_string(scores.size()) + " and right of " +
                      std::to_string(right.size()) +
                      " numbers: expected one share for each score, and at least one score");
  }
  if (std::adjacent_find(scores.begin(), scores.end(), std::greater_equal<>()) != scores.end()) {
    throw OptionError("scores: expected each to be larger than the one before");
  }
  if (mistaken.size() != kReported.size() * kObjectClasses) {
    throw OptionError("mistaken of " + std::to_string(mistaken.size()) +
                      " numbers: expected 3 rows (pedestrian, cyclist, vehicle as reported) of " +
                      std::to_string(kObjectClasses));
  }
}

ClassReliability::ClassReliability(const Checked<ClassReliabilityOptions>& options)
    : options_(*options) {}

bool ClassReliability::isInformative() const {
  return std::any_of(options_.right.begin(), options_.right.end(),
                     [](double share) { return share > kChance; });
}

double ClassReliability::right(double score) const {
  const auto& scores = options_.scores;
  const auto& shares = options_.right;
  if (!(score > scores.front())) {
    return shares.front();
  }
  const auto above = std::upper_bound(scores.begin(), scores.end(), score);
  if (above == scores.end()) {
    return shares.back();
  }
  const auto i = static_cast<std::size_t>(above - scores.begin());
  const double part = (score - scores[i - 1]) / (scores[i] - scores[i - 1]);
  return shares[i - 1] + part * (shares[i] - shares[i - 1]);
}

ClassProbabilities ClassReliability::probabilities(ObjectClass reported, double score) const {
  ClassProbabilities result = ClassBelief().probabilities();
  const auto found = std::find(kReported.begin(), kReported.end(), reported);
  if (found == kReported.end()) {
    return result;
  }
  const auto row = static_cast<std::size_t>(found - kReported.begin()) * kObjectClasses;
  const auto own = static_cast<std::size_t>(reported);
  double others = 0.0;
  for (std::size_t i = 0; i < kObjectClasses; ++i) {
    others += i == own ? 0.0 : options_.mistaken[row + i];
  }
  const double is_right = right(score);
  if (is_right <= kChance) {
    return result;
  }
  const double equally = 1.0 / static_cast<double>(kObjectClasses - 1);
  for (std::size_t i = 0; i < kObjectClasses; ++i) {
    const double share = others > 0.0 ? options_.mistaken[row + i] / others : equally;
    result[i] = i == own ? is_right : (1.0 - is_right) * share;
  }
  return result;
}

}  // namespace datmo
