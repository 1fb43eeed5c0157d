// SPDX-License-Identifier: BSD-3-Clause
#include "command_line.h"

#include <algorithm>
#include <cstdlib>
#include <iostream>

#include <CLI/CLI.hpp>

namespace datmo {

namespace {

const std::string kRequires = " requires ";  // wording of CLI11

constexpr std::size_t kHelpColumn = 25;  ///< characters, of the options' names

std::string notEmpty(const std::string& name) {
  return name.empty() ? "'': expected the name of a file" : "";
}

bool isOption(const std::string& word) { return !word.empty() && word.front() == '-'; }

constexpr char kRemapTo[] = ":=";

/// Of a word with kRemapTo at `separator`. Throws UsageError.
Remapping remappingOf(const std::string& word, std::size_t separator,
                      const std::vector<std::string>& topics) {
  const std::string theirs = word.substr(separator + 2);
  std::string names;
  for (const std::string& topic : topics) {
    if (withSlash(topic) == withSlash(word.substr(0, separator)) && !theirs.empty()) {
      return {topic, withSlash(theirs)};
    }
    names += (names.empty() ? "" : ", ") + topic;
  }
  throw UsageError("'" + word + "': expected one of " + names + ", followed by := and a topic");
}

}  // namespace

CommandLine::CommandLine(const std::string& program, const std::string& description,
                         std::string files)
    : CLI::App(description, program), files_(std::move(files)) {
  option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  get_formatter()->label("Usage", "usage");
  // For words that are not options the name is sufficient.
  get_formatter()->label("TEXT", "");
  get_formatter()->label("REQUIRED", "");
  get_formatter()->column_width(kHelpColumn);
}

CLI::Option* CommandLine::addFile(const std::string& name, std::string& file,
                                  const std::string& help, const std::string& text) {
  CLI::Option* option = add_option(name, file, help)->check(CLI::Validator(notEmpty, ""));
  return text.empty() ? option : option->option_text(text);
}

CLI::Option* CommandLine::addRepeated(const std::string& name, std::vector<std::string>& values,
                                      const std::string& help, const std::string& text) {
  return add_option(name, values, help)->take_all()->allow_extra_args(false)->option_text(text);
}

void CommandLine::addAnswer(const std::string& name, const std::function<std::string()>& answer,
                            const std::string& help) {
  add_flag_callback(
      name, [answer] { throw Answer(answer()); }, help);
}

void CommandLine::read(std::vector<std::string> words) {
  std::reverse(words.begin(), words.end());  // the order that CLI11 expects
  try {
    parse(std::move(words));
  } catch (const CLI::CallForHelp&) {
    throw Answer(help());
  } catch (const CLI::ParseError& error) {
    throw usageError(error);
  }
}

std::string CommandLine::listed(const std::vector<std::string>& names) {
  std::string list;
  for (std::size_t i = 0; i < names.size(); ++i) {
    list += (i == 0 ? "" : i + 1 == names.size() ? " or " : ", ") + names[i];
  }
  return list;
}

UsageError CommandLine::wrongWords() const {
  std::vector<std::string> options;
  std::string expected;
  std::size_t files = 0;
  for (const CLI::Option* option : get_options()) {
    const std::string& name = option->get_name();
    if (option->get_positional()) {
      files += option->count();
    } else if (option != get_help_ptr()) {
      options.push_back(name);
    }
    if (option->get_required() || option->get_positional()) {
      expected += " " + (option->get_required() ? name : "[" + name + "]");
    }
  }
  for (const std::string& word : remaining()) {
    if (isOption(word)) {
      return UsageError("'" + word + "': expected " +
                        (options.empty() ? "no option" : listed(options)));
    }
    ++files;
  }
  return UsageError(std::to_string(files) + " " + files_ + " are given: expected" +
                    (expected.empty() ? " none" : expected));
}

UsageError CommandLine::usageError(const CLI::ParseError& error) const {
  const std::string what = error.what();  // "--option: why"
  const std::string option = what.substr(0, what.find(':'));
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr ||
      dynamic_cast<const CLI::RequiredError*>(&error) != nullptr) {
    return wrongWords();
  }
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr) {
    return UsageError(option + ": expected a value after it");
  }
  if (dynamic_cast<const CLI::ValidationError*>(&error) != nullptr) {
    return UsageError(option + what.substr(option.size() + 1));
  }
  if (dynamic_cast<const CLI::RequiresError*>(&error) != nullptr) {
    const std::size_t requires_at = what.find(kRequires);
    return UsageError(what.substr(0, requires_at) + ": expected " +
                      what.substr(requires_at + kRequires.size()) + " with it");
  }
  return UsageError(what);
}

std::string withSlash(const std::string& topic) {
  return topic.empty() || topic.front() == '/' ? topic : "/" + topic;
}

std::vector<Remapping> takeRemappings(std::vector<std::string>& words,
                                      const std::vector<std::string>& topics) {
  std::vector<Remapping> remappings;
  std::vector<std::string> others;
  for (const std::string& word : words) {
    const std::size_t separator = word.find(kRemapTo);
    if (separator == std::string::npos) {
      others.push_back(word);
    } else {
      remappings.push_back(remappingOf(word, separator, topics));
    }
  }
  words = std::move(others);
  return remappings;
}

int runProgram(const std::string& program, int failure, int count, char** words,
               const std::function<void(const std::vector<std::string>&)>& work) {
  const auto fail = [&program](const std::exception& error, int code) {
    std::cerr << program << ": " << error.what() << '\n';
    return code;
  };
  try {
    work(std::vector<std::string>(words + 1, words + count));
  } catch (const Answer& answer) {
    std::cout << answer.what();
  } catch (const NoUsableInput& error) {
    return fail(error, kNoUsableInput);
  } catch (const std::exception& error) {
    return fail(error, failure);
  }
  return EXIT_SUCCESS;
}

}  // namespace datmo
