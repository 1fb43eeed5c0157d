// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <iosfwd>
#include <string>

namespace datmo {

/// One line on a terminal that shows how far a job is, drawn over again a few times a second.
class ProgressBar {
 public:
  /// `out` null: draws nothing.
  explicit ProgressBar(std::ostream* out);
  /// Clears the line, so that what is printed next, be it an error, has it for itself.
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// `share` of the job that is done, 0 to 1; `note` stands behind the bar.
  void show(double share, const std::string& note);

 private:
  using Clock = std::chrono::steady_clock;

  std::ostream* out_;
  Clock::time_point drawn_;
};

}  // namespace datmo
