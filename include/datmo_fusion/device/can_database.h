// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "datmo_fusion/device/can_signal.h"

namespace datmo {

/// Returns a signal of a DBC file by its name, or by MESSAGE.SIGNAL if several messages have one of
/// that name. Throws OptionError for a file that cannot be read, a name that no signal or several
/// signals have, and for multiplexed and floating-point signals. `option`: name of the option, for
/// the error message.
CanSignal canSignalOf(const std::string& option, const std::string& file, const std::string& name);

/// Returns the signal that an option specifies, as CanOptions describes it. `name`: of the option;
/// `dbc`: the DBC file for names, empty: none. Throws OptionError.
CanSignal canSignalFrom(const std::string& name, const std::string& text, const std::string& dbc);

}  // namespace datmo
