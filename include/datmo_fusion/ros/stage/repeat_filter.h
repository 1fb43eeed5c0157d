// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "datmo_fusion/ros/stage/input_error.h"

namespace datmo {

/// Keeps a console readable: an error is printed the first time, and again when its cause changes
/// or when it returns after a long quiet time. Repetitions are only counted by reason.
///
/// Two errors have the same cause if they have the same reason and their messages differ only in
/// numbers: "tilted by 12.1 degrees" and "tilted by 12.3 degrees". Not thread safe.
class RepeatFilter {
 public:
  /// Returns the line to print for `error`, from the second time on with the count of its reason;
  /// none for a repetition. `now`: s, on any monotonic clock; `count`: number of affected messages.
  std::optional<std::string> lineOf(const InputError& error, double now, std::uint64_t count = 1);

 private:
  struct Reason {
    std::uint64_t count = 0;
    std::map<std::string, double> last_seen;  ///< by cause, s
  };

  static bool isNews(Reason& reason, const std::string& cause, double now);

  std::map<std::string, Reason> reasons_;
};

}  // namespace datmo
