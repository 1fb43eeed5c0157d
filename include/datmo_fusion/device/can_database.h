// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "datmo_fusion/device/can_signal.h"

namespace datmo {

/// A signal of a DBC file by its name, or by MESSAGE.SIGNAL where several messages have one of that
/// name. Throws OptionError for a file that cannot be read, a name that none or several have, and
/// for multiplexed and floating-point signals. `option`: what it is for, for the message.
CanSignal canSignalOf(const std::string& option, const std::string& file, const std::string& name);

}  // namespace datmo
