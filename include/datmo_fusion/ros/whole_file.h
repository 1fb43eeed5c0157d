// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace datmo {

/// Throws std::runtime_error that names the file and says why it cannot be written: a folder, no
/// folder to write it in, no permission there. For the start of work whose result it is to hold.
void checkWritable(const std::string& file);

/// Writes a text file that appears under its name when it is complete, and not at all otherwise: it
/// is written beside it as `<file>.part` first. What stood there before stays until then. Throws
/// std::runtime_error that names the file if it cannot be written: a folder, no rights, a full
/// disk.
void writeWholeFile(const std::string& file, const std::string& text);

}  // namespace datmo
