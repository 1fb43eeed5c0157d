// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <exception>
#include <string>

#include "datmo_fusion/ros/stage/stage_monitor.h"

namespace datmo {

/// Runs a callback of a host. Exceptions are caught, since one would end the process and all its
/// nodelets: they are counted and reported to the monitor, and the message that caused it is
/// dropped. `input`: the topic, or the name of another caller.
template <typename Callback>
void guarded(StageMonitor& monitor, const std::string& input, const Callback& callback) {
  try {
    callback();
  } catch (const InputError& error) {
    monitor.dropped(error);
  } catch (const std::exception& error) {
    monitor.dropped(
        InputError("unexpected_error",
                   "at a message on " + input + ": " + error.what() +
                       ": drops it and continues; expected no such error: please report it"));
  }
}

}  // namespace datmo
