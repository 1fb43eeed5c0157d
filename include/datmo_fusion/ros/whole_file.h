// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace datmo {

/// Throws std::runtime_error with the file's name and the reason if it cannot be written: it is a
/// directory, its directory does not exist, or permission is missing. Call it before starting work
/// whose result goes there.
void checkWritable(const std::string& file);

/// A text, and the name of its file.
struct NamedText {
  std::string file;
  std::string text;
};

/// Writes text files, each name once, all together or not at all: each is written as `<file>.part`
/// first, and they appear under their names, in this order, only when all are complete. Existing
/// files are kept until then, and links are replaced, not followed. Throws std::runtime_error with
/// the name of a file that cannot be written: a directory, missing permission, a full disk. If
/// renaming a complete file fails, those before it have their names already.
void writeWholeFiles(const std::vector<NamedText>& files);

/// The same for one file.
void writeWholeFile(const std::string& file, std::string text);

}  // namespace datmo
