#pragma once

#include <string>

namespace datmo {

/// The parameters of all nodelets: for each a heading and a Markdown table.
std::string parameterTables();

}  // namespace datmo
