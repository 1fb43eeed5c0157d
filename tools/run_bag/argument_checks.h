// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "arguments.h"

namespace datmo {

/// Checks that the options of `run_bag` are consistent: no two outputs are the same file, each
/// requested stage runs, and what an option applies to exists. Throws UsageError, which names the
/// option.
void checkArguments(const Arguments& arguments);

}  // namespace datmo
