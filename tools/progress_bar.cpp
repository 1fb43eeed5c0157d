// SPDX-License-Identifier: BSD-3-Clause
#include "progress_bar.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <ostream>

namespace datmo {

namespace {

constexpr int kWidth = 40;
constexpr std::chrono::milliseconds kRedrawAfter{100};

}  // namespace

ProgressBar::ProgressBar(std::ostream* out) : out_(out), drawn_(Clock::now() - kRedrawAfter) {}

void ProgressBar::show(double share, const std::string& note) {
  const Clock::time_point now = Clock::now();
  if (out_ == nullptr || now - drawn_ < kRedrawAfter) {
    return;
  }
  drawn_ = now;
  const double done = std::min(1.0, std::max(0.0, share));
  const auto filled = static_cast<std::size_t>(std::lround(done * kWidth));
  *out_ << "\r\033[K[" << std::string(filled, '#') << std::string(kWidth - filled, ' ') << "] "
        << std::setw(3) << std::lround(100.0 * done) << " % " << note << std::flush;
}

ProgressBar::~ProgressBar() {
  if (out_ != nullptr) {
    *out_ << "\r\033[K" << std::flush;
  }
}

}  // namespace datmo
