// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace datmo::kitti {

/// The columns of one line of a text file. What is wrong with one throws std::runtime_error that
/// names file, line number, column, value and what was expected.
class TextLine {
 public:
  TextLine(std::string position, std::vector<std::string> columns);

  const std::vector<std::string>& columns() const { return columns_; }

  /// The column's text as a finite number, as a whole one of at least `min` and at most `max`,
  /// as a number of at least 0. `name` is that of the column in messages.
  double number(std::size_t column, const std::string& name) const;
  int integer(std::size_t column, const std::string& name, int min, int max) const;
  double size(std::size_t column, const std::string& name) const;

  void expectColumns(std::size_t count) const;

  /// Throws: the file, the line, `found` and `expected`.
  [[noreturn]] void fail(const std::string& found, const std::string& expected) const;

 private:
  std::string position_;
  std::vector<std::string> columns_;
};

/// Calls `use` for each line of a file that is not empty. `separator` is between two columns; where
/// it is a blank, any number of blanks is. Throws std::runtime_error if the file cannot be read.
void forEachLine(const std::string& file, char separator,
                 const std::function<void(const TextLine&)>& use);

}  // namespace datmo::kitti
