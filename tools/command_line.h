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

/// The command line is wrong; the message says what, its value, and what was expected.
class UsageError : public OptionError {
 public:
  using OptionError::OptionError;
};

/// What a program prints in place of its work: its help, a table of its options.
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

/// The words that a choice may be, and what each of them stands for.
template <typename Value>
using Choices = std::vector<std::pair<std::string, Value>>;

/// A command line of CLI11 as all programs here have it: of an option given twice the last one
/// holds, a repeated one takes a single value each time, and errors say what was expected.
class CommandLine : public CLI::App {
 public:
  /// `files`: what the words that are no options name: "bags". `program` stands in the help.
  CommandLine(const std::string& program, const std::string& description, std::string files);

  /// An option with, or a word that is, the name of a file or folder. `text`: what the help calls
  /// the value, for an option.
  CLI::Option* addFile(const std::string& name, std::string& file, const std::string& help,
                       const std::string& text = "");

  /// An option that may be given several times, with one value each time.
  CLI::Option* addRepeated(const std::string& name, std::vector<std::string>& values,
                           const std::string& help, const std::string& text);

  /// An option whose value is one of several words.
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

  /// An option that is answered at once: nothing else is needed then.
  void addAnswer(const std::string& name, const std::function<std::string()>& answer,
                 const std::string& help);

  /// Reads the words behind the program's name into what was added. Throws UsageError, and Answer
  /// for --help.
  void read(std::vector<std::string> words);

 private:
  static std::string listed(const std::vector<std::string>& names);

  /// A word too many, or one that is missing.
  UsageError wrongWords() const;
  UsageError usageError(const CLI::ParseError& error) const;

  std::string files_;
};

/// A topic of a bag under another name than ours.
struct Remapping {
  std::string ours;    ///< as in `topics`
  std::string theirs;  ///< with a leading slash
};

/// Takes the words `ours:=theirs` out of a command line, as ROS does. Throws UsageError for one
/// that is none of `topics`, or lacks the other name.
std::vector<Remapping> takeRemappings(std::vector<std::string>& words,
                                      const std::vector<std::string>& topics);

/// `topic` with a slash at its front, unless it is empty.
std::string withSlash(const std::string& topic);

/// Runs a program to its exit code: its answer goes to standard output, and an exception's message
/// to standard error, in one line behind the program's name. `failure`: the exit code then, but
/// kNoUsableInput after NoUsableInput.
int runProgram(const std::string& program, int failure, int count, char** words,
               const std::function<void(const std::vector<std::string>&)>& work);

}  // namespace datmo
