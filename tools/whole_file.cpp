#include "whole_file.h"

#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace datmo {

void writeWholeFile(const std::string& file, const std::string& text) {
  if (std::filesystem::is_directory(file)) {
    throw std::runtime_error(file + ": is a folder, expected the name of a file");
  }
  const std::string part = file + ".part";
  try {
    std::ofstream stream;
    stream.exceptions(std::ios::failbit | std::ios::badbit);
    stream.open(part, std::ios::binary);
    stream << text;
    stream.close();
    std::filesystem::rename(part, file);
  } catch (const std::exception& error) {
    std::error_code ignored;
    std::filesystem::remove(part, ignored);
    throw std::runtime_error(file + ": cannot be written (" + error.what() + ")");
  }
}

}  // namespace datmo
