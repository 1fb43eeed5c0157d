#pragma once

#include <string>

namespace datmo {

/// Writes a text file that appears under its name when it is complete, and not at all otherwise: it
/// is written beside it as `<file>.part` first. What stood there before stays until then. Throws
/// std::runtime_error that names the file if it cannot be written: a folder, no rights, a full
/// disk.
void writeWholeFile(const std::string& file, const std::string& text);

}  // namespace datmo
