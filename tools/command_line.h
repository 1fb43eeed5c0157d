// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <CLI/App.hpp>

#include "datmo_fusion/common/options.h"

namespace datmo {

/// The command line is invalid; the message names the option, its value, and what was expected.
class UsageError : public OptionError {
 public:
  using OptionError::OptionError;
};

/// What a program prints instead of doing its work: its help, or a table of its options.
class Answer : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Nothing of the input could be used; the message says why.
class NoUsableInput : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Exit code after NoUsableInput.
inline constexpr int kNoUsableInput = 2;

/// The allowed words of a choice, and the value of each.
template <typename Value>
using Choices = std::vector<std::pair<std::string, Value>>;

/// A CLI11 command line with the conventions of all programs here: if an option is given twice, the
/// last one is used; a repeatable option takes a single value each time; errors state what was
/// expected.
class CommandLine : public CLI::App {
 public:
  /// `files`: what the words that are not options name, such as "bags". `program` is shown in the
  /// help.
  CommandLine(const std::string& program, const std::string& description, std::string files);

  /// Adds an option whose value is, or a word that is, the name of a file or folder. `text`: name
  /// of the value in the help, for an option.
  CLI::Option* addFile(const std::string& name, std::string& file, const std::string& help,
                       const std::string& text = "");

  /// Adds an option that may be given several times, with one value each time.
  CLI::Option* addRepeated(const std::string& name, std::vector<std::string>& values,
                           const std::string& help, const std::string& text);

  /// Adds an option whose value is one of several words.
  template <typename Value>
  CLI::Option* addChoice(const std::string& name, Value& value, const Choices<Value>& choices,
                         const std::string& help, const std::string& text) {
    const auto choose = [name, &value, choices](const std::string& word) {
      std::vector<std::string> names;
      for (const auto& [choice, meant] : choices) {
        if (choice == word) {
          value = meant;
          return;
        }
        names.push_back(choice);
      }
      throw UsageError(name + " '" + word + "': expected " + listed(names));
    };
    return add_option_function<std::string>(name, choose, help)->option_text(text);
  }

  /// Adds an option that is answered immediately; nothing else is required then.
  void addAnswer(const std::string& name, const std::function<std::string()>& answer,
                 const std::string& help);

  /// Parses the words after the program's name into the options added. Throws UsageError, and
  /// Answer for --help.
  void read(std::vector<std::string> words);

 private:
  static std::string listed(const std::vector<std::string>& names);

  /// A word too many, or one that is missing.
  UsageError wrongWords() const;
  UsageError usageError(const CLI::ParseError& error) const;

  std::string files_;
};

/// A topic that has another name in the bag.
struct Remapping {
  std::string ours;    ///< as in `topics`
  std::string theirs;  ///< with a leading slash
};

/// Removes the words `ours:=theirs` from a command line, as ROS does. Throws UsageError for a name
/// that is not in `topics`, or if the other name is missing.
std::vector<Remapping> takeRemappings(std::vector<std::string>& words,
                                      const std::vector<std::string>& topics);

/// Returns `topic` with a leading slash, unless it is empty.
std::string withSlash(const std::string& topic);

/// Runs a program and returns its exit code. An Answer is printed to standard output, an
/// exception's message to standard error, in one line after the program's name. `failure`: the exit
/// code after an exception, except kNoUsableInput after NoUsableInput.
int runProgram(const std::string& program, int failure, int count, char** words,
               const std::function<void(const std::vector<std::string>&)>& work);

}  // namespace datmo
