// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>

namespace datmo {

/// A point in time of the data (never of the wall clock), in nanoseconds since the clock's epoch.
struct Stamp {
  std::int64_t nanoseconds = 0;

  static Stamp fromSeconds(double seconds) {
    return {static_cast<std::int64_t>(std::llround(seconds * 1e9))};
  }
  double seconds() const { return static_cast<double>(nanoseconds) * 1e-9; }
};

inline bool operator==(Stamp a, Stamp b) { return a.nanoseconds == b.nanoseconds; }
inline bool operator!=(Stamp a, Stamp b) { return a.nanoseconds != b.nanoseconds; }
inline bool operator<(Stamp a, Stamp b) { return a.nanoseconds < b.nanoseconds; }
inline bool operator<=(Stamp a, Stamp b) { return a.nanoseconds <= b.nanoseconds; }
inline bool operator>(Stamp a, Stamp b) { return b < a; }
inline bool operator>=(Stamp a, Stamp b) { return b <= a; }

/// Returns the time from one stamp to another, s; negative if `to` is the earlier one.
inline double secondsBetween(Stamp from, Stamp to) {
  return static_cast<double>(to.nanoseconds - from.nanoseconds) * 1e-9;
}

inline Stamp operator+(Stamp stamp, double seconds) {
  return {stamp.nanoseconds + static_cast<std::int64_t>(std::llround(seconds * 1e9))};
}

}  // namespace datmo
