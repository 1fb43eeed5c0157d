// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace datmo::kitti {

/// The columns of one line of a text file. An invalid column throws std::runtime_error that names
/// file, line number, column, value and what was expected.
class TextLine {
 public:
  TextLine(std::string position, std::vector<std::string> columns);

  const std::vector<std::string>& columns() const { return columns_; }

  /// Returns the column as a finite number, as an integer from `min` to `max`, as a number of at
  /// least 0. `name`: of the column, for messages.
  double number(std::size_t column, const std::string& name) const;
  int integer(std::size_t column, const std::string& name, int min, int max) const;
  double size(std::size_t column, const std::string& name) const;

  void expectColumns(std::size_t count) const;

  /// Throws an error with the file, the line, `found` and `expected`.
  [[noreturn]] void fail(const std::string& found, const std::string& expected) const;

 private:
  std::string position_;
  std::vector<std::string> columns_;
};

/// Calls `use` for each non-empty line of a file. `separator` separates columns; if it is a blank,
/// any number of blanks does. Throws std::runtime_error if the file cannot be read.
void forEachLine(const std::string& file, char separator,
                 const std::function<void(const TextLine&)>& use);

}  // namespace datmo::kitti
