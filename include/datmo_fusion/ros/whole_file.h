// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace datmo {

/// Throws std::runtime_error with the file's name and the reason if it cannot be written: it is a
/// directory, its directory does not exist, or permission is missing. Call it before starting work
/// whose result goes there.
void checkWritable(const std::string& file);

/// Writes a text file atomically: it is written as `<file>.part` first, and appears under its name
/// only when complete. An existing file is kept until then, and links are replaced, not followed.
/// Throws std::runtime_error with the file's name if it cannot be written: a directory, missing
/// permission, a full disk.
void writeWholeFile(const std::string& file, const std::string& text);

}  // namespace datmo
