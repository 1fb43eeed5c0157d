// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <datmo_fusion/RiskArray.h>

#include "datmo_fusion/risk/risk.h"

namespace datmo {

using RiskMessage = datmo_fusion::Risk;
using datmo_fusion::RiskArray;
using datmo_fusion::RiskArrayConstPtr;
using datmo_fusion::RiskArrayPtr;

/// Omits the counts, which the message does not have.
RiskArray toMessage(const RiskReport& report, const std::string& fixed_frame);

}  // namespace datmo
