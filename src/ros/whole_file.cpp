// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/whole_file.h"

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

namespace datmo {

namespace {

/// Read and write permission for all, less the umask, as std::ofstream creates files.
constexpr mode_t kMode = 0666;

/// Creates an empty file in place of one that an interrupted call has left. A link that someone
/// else has put there is not followed.
void createAnew(const std::string& file) {
  std::filesystem::remove(file);
  const int descriptor =
      open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, kMode);
  if (descriptor < 0) {
    throw std::system_error(errno, std::generic_category());
  }
  close(descriptor);
}

std::string partOf(const std::string& file) { return file + ".part"; }

void writePart(const NamedText& file) {
  const std::string part = partOf(file.file);
  createAnew(part);
  std::ofstream stream;
  stream.exceptions(std::ios::failbit | std::ios::badbit);
  stream.open(part, std::ios::binary);
  stream << file.text;
  stream.close();
}

/// Adds the file's name to what `write` throws.
void naming(const std::string& file, const std::function<void()>& write) {
  try {
    write();
  } catch (const std::exception& error) {
    throw std::runtime_error(file + ": cannot be written (" + error.what() + ")");
  }
}

}  // namespace

void checkWritable(const std::string& file) {
  if (std::filesystem::is_directory(file)) {
    throw std::runtime_error(file + ": is a folder, expected the name of a file");
  }
  std::error_code ignored;  // an inaccessible file counts as missing
  const std::filesystem::file_status status = std::filesystem::status(file, ignored);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
    throw std::runtime_error(file + ": is a pipe or a device, expected the name of a file");
  }
  const std::filesystem::path parent = std::filesystem::path(file).parent_path();
  const std::string folder = parent.empty() ? "." : parent.string();
  if (!std::filesystem::is_directory(folder)) {
    throw std::runtime_error(file + ": cannot be written (no folder " + folder + ")");
  }
  if (access(folder.c_str(), W_OK) != 0) {
    throw std::runtime_error(file + ": cannot be written (no permission to write in " + folder +
                             ")");
  }
}

void writeWholeFiles(const std::vector<NamedText>& files) {
  for (const NamedText& each : files) {
    checkWritable(each.file);
  }
  try {
    for (const NamedText& each : files) {
      naming(each.file, [&each] { writePart(each); });
    }
    for (const NamedText& each : files) {
      naming(each.file, [&each] { std::filesystem::rename(partOf(each.file), each.file); });
    }
  } catch (const std::exception&) {
    for (const NamedText& each : files) {
      std::error_code ignored;
      std::filesystem::remove(partOf(each.file), ignored);
    }
    throw;
  }
}

void writeWholeFile(const std::string& file, std::string text) {
  std::vector<NamedText> files;  // filled later: an initializer list would copy the text
  files.push_back({file, std::move(text)});
  writeWholeFiles(files);
}

}  // namespace datmo
