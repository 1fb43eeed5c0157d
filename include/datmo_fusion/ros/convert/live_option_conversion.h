// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <dynamic_reconfigure/Config.h>
#include <dynamic_reconfigure/ConfigDescription.h>

#include "datmo_fusion/common/live_options.h"

namespace datmo {

/// Describes live options for dynamic_reconfigure, which has no lists: these are omitted.
dynamic_reconfigure::ConfigDescription descriptionOf(const std::vector<LiveOption>& options);

/// Returns their values; lists are omitted.
dynamic_reconfigure::Config configOf(const std::vector<LiveOption>& options);

/// Returns the values that a client requests, by key.
OptionValues valuesOf(const dynamic_reconfigure::Config& config);

}  // namespace datmo
