#pragma once

#include <chrono>

namespace datmo {

/// Seconds since construction by the machine's own clock: for diagnostics, never for the data.
class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace datmo
