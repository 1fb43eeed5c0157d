// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace datmo {

/// The parameters of all nodelets as a page of Markdown (doc/parameters.md): for each nodelet a
/// heading and a table.
std::string parameterTables();

}  // namespace datmo
