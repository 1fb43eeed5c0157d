// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>

namespace datmo {

/// Waits until a file or socket has one of the events of poll(); returns false after the timeout
/// (s), or when `stop` is set.
bool waitForEvents(int descriptor, short events, double timeout, const std::atomic<bool>& stop);

}  // namespace datmo
