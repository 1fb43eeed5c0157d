// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace datmo {

/// Processing times of each stage for each message: for reports only, never used by the stages.
class StageTimes {
 public:
  void add(const std::string& stage, double seconds);

  struct Summary {
    std::string stage;
    std::size_t runs = 0;
    double mean = 0.0;           ///< s
    double median = 0.0;         ///< s
    double percentile_99 = 0.0;  ///< s
  };

  /// One for each stage, in the order of their first run.
  std::vector<Summary> summaries() const;

 private:
  std::vector<std::pair<std::string, std::vector<double>>> seconds_;
};

/// A JSON object: stage -> {runs, mean_s, median_s, percentile_99_s}.
std::string toJson(const StageTimes& times);

}  // namespace datmo
