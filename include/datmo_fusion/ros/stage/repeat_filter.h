// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "datmo_fusion/ros/stage/input_error.h"

namespace datmo {

/// Keeps a console readable: an error is said the first time, and again when its cause changes or
/// when it comes back after a long quiet. Repetitions are counted by reason, not said.
///
/// Two errors have the same cause if they have the same reason and their messages differ in numbers
/// alone: "tilted by 12.1 degrees" and "tilted by 12.3 degrees". Not thread safe.
class RepeatFilter {
 public:
  /// The line to write for `error`, with the number of its reason so far from the second one on;
  /// none for a repetition. `now`: s, on any clock that does not go back; `count`: of messages that
  /// have it.
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
