// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <iosfwd>
#include <string>

namespace datmo {

/// A line on a terminal that shows the progress of a job, redrawn a few times a second.
class ProgressBar {
 public:
  /// If `out` is null, nothing is drawn.
  explicit ProgressBar(std::ostream* out);
  /// Clears the line, so that the next output, such as an error, starts on an empty line.
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// `share` of the job that is done, 0 to 1; `note` is shown after the bar.
  void show(double share, const std::string& note);

 private:
  using Clock = std::chrono::steady_clock;

  std::ostream* out_;
  Clock::time_point drawn_;
};

}  // namespace datmo
