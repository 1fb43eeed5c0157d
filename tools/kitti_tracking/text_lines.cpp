// SPDX-License-Identifier: BSD-3-Clause
#include "kitti_tracking/text_lines.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace datmo::kitti {

namespace {

constexpr char kBlank = ' ';

std::vector<std::string> columnsOf(const std::string& line, char separator) {
  std::vector<std::string> columns;
  std::istringstream stream(line);
  std::string column;
  while (separator == kBlank ? static_cast<bool>(stream >> column)
                             : static_cast<bool>(std::getline(stream, column, separator))) {
    columns.push_back(column);
  }
  return columns;
}

bool isBlank(const std::string& line) { return line.find_first_not_of(" \t") == std::string::npos; }

/// Files from Windows end their lines with a carriage return.
void dropCarriageReturn(std::string& line) {
  if (!line.empty() && line.back() == '\r') {
    line.pop_back();
  }
}

}  // namespace

TextLine::TextLine(std::string position, std::vector<std::string> columns)
    : position_(std::move(position)), columns_(std::move(columns)) {}

double TextLine::number(std::size_t column, const std::string& name) const {
  const std::string& text = columns_.at(column);
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !std::isfinite(value)) {
    fail(name + " '" + text + "'", "a finite number");
  }
  return value;
}

int TextLine::integer(std::size_t column, const std::string& name, int min, int max) const {
  const double value = number(column, name);
  if (value < min || value > max || value != std::floor(value)) {
    fail(name + " '" + columns_.at(column) + "'",
         "a whole number of " + std::to_string(min) + " to " + std::to_string(max));
  }
  return static_cast<int>(value);
}

double TextLine::size(std::size_t column, const std::string& name) const {
  const double value = number(column, name);
  if (value < 0.0) {
    fail(name + " '" + columns_.at(column) + "'", "at least 0");
  }
  return value;
}

void TextLine::expectColumns(std::size_t count) const {
  if (columns_.size() != count) {
    fail(std::to_string(columns_.size()) + " columns", std::to_string(count));
  }
}

void TextLine::fail(const std::string& found, const std::string& expected) const {
  throw std::runtime_error(position_ + ": " + found + ", expected " + expected);
}

void forEachLine(const std::string& file, char separator,
                 const std::function<void(const TextLine&)>& use) {
  std::ifstream stream(file);
  if (!stream || std::filesystem::is_directory(file)) {
    throw std::runtime_error(file + ": cannot be read, expected a text file");
  }
  std::string line;
  for (std::size_t number = 1; std::getline(stream, line); ++number) {
    dropCarriageReturn(line);
    if (!isBlank(line)) {
      use(TextLine(file + ":" + std::to_string(number), columnsOf(line, separator)));
    }
  }
}

}  // namespace datmo::kitti
