// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "arguments.h"

namespace datmo {

/// Whether the options of `run_bag` go together: two outputs are not one file, a stage that is
/// asked for runs, and what an option is for is there. Throws UsageError, which names the option.
void checkArguments(const Arguments& arguments);

}  // namespace datmo
