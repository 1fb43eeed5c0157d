// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <dynamic_reconfigure/Config.h>
#include <dynamic_reconfigure/ConfigDescription.h>

#include "datmo_fusion/common/live_options.h"

namespace datmo {

/// Live options as dynamic_reconfigure describes them. Lists are left out: it has none.
dynamic_reconfigure::ConfigDescription descriptionOf(const std::vector<LiveOption>& options);

/// Their values; lists are left out.
dynamic_reconfigure::Config configOf(const std::vector<LiveOption>& options);

/// The values that a client asks for, by key.
OptionValues valuesOf(const dynamic_reconfigure::Config& config);

}  // namespace datmo
