// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/device/can_database.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <regex>
#include <vector>

#include "datmo_fusion/common/options.h"

namespace datmo {

namespace {

constexpr std::size_t kLongestLine = 1000;  ///< characters, of a line that defines a signal

/// An SG_ line that matches a name.
struct Entry {
  std::string message;
  std::uint64_t id = 0;
  bool is_multiplexed = false;
  std::string form;  ///< after the colon
};

struct Found {
  std::vector<Entry> entries;
  bool is_float = false;  ///< according to SIG_VALTYPE_, for at least one of them
};

bool fits(const std::string& name, const std::string& message, const std::string& signal) {
  return name == signal || name == message + "." + signal;
}

Found findSignal(std::istream& file, const std::string& name) {
  static const std::regex message_line(R"(\s*BO_\s+(\d{1,10})\s+(\w+)\s*:.*)");
  static const std::regex signal_line(R"(\s*SG_\s+(\w+)(\s+M|\s+m\d+M?)?\s*:(.*))");
  static const std::regex type_line(R"(\s*SIG_VALTYPE_\s+(\d{1,10})\s+(\w+)\s*:?\s*([123])\s*;.*)");
  Found found;
  std::string message;
  std::uint64_t id = 0;
  for (std::string line; std::getline(file, line);) {
    if (line.size() > kLongestLine) {
      continue;  // a comment
    }
    if (!line.empty() && line.back() == '\r') {
      line.pop_back();
    }
    std::smatch part;
    if (std::regex_match(line, part, message_line)) {
      id = std::stoull(part[1]);
      message = part[2];
    } else if (std::regex_match(line, part, signal_line) && fits(name, message, part[1])) {
      const std::string mark = part[2];
      found.entries.push_back({message, id, mark.find('m') != std::string::npos, part[3]});
    } else if (std::regex_match(line, part, type_line)) {
      for (const Entry& entry : found.entries) {
        found.is_float = found.is_float ||
                         (entry.id == std::stoull(part[1]) && fits(name, entry.message, part[2]));
      }
    }
  }
  return found;
}

}  // namespace

CanSignal canSignalOf(const std::string& option, const std::string& file, const std::string& name) {
  std::ifstream stream(file);
  if (!stream) {
    throw OptionError("the DBC file '" + file + "' cannot be read (" + std::strerror(errno) +
                      "): expected one that has " + option + ", '" + name + "'");
  }
  const Found found = findSignal(stream, name);
  const std::string named = option + ": the signal '" + name + "' of " + file;
  if (found.entries.empty()) {
    throw OptionError(named + " does not exist: expected the name of a signal (SG_)");
  }
  const Entry& entry = found.entries.front();
  if (found.entries.size() > 1) {
    throw OptionError(named + " is in several messages: expected one of them, for example " +
                      entry.message + "." + name);
  }
  if (entry.is_multiplexed || found.is_float) {
    throw OptionError(named + " is " + (found.is_float ? "a float" : "multiplexed") +
                      ": expected an integer that is always in its message");
  }
  return canSignal(named, canId(named, entry.id), entry.form);
}

CanSignal canSignalFrom(const std::string& name, const std::string& text, const std::string& dbc) {
  if (text.find('|') == std::string::npos) {
    if (dbc.empty()) {
      throw OptionError(name + " is '" + text +
                        "': expected `0x1A0 8|16@1+ (0.01,0) [0|250] \"km/h\"`, or a file in "
                        "can/dbc that has a signal of that name");
    }
    return canSignalOf(name, dbc, text);
  }
  static const std::regex form(R"(\s*(0[xX][0-9a-fA-F]{1,8}|\d{1,10})\s*:?\s+(.*))");
  std::smatch part;
  if (!std::regex_match(text, part, form)) {
    throw OptionError(name + " is '" + text +
                      "': expected the message's id first, `0x1A0 8|16@1+ "
                      "(0.01,0) [0|250] \"km/h\"`");
  }
  const std::string id = part[1];
  const bool is_hexadecimal = id.size() > 1 && (id[1] == 'x' || id[1] == 'X');
  return canSignal(name, canId(name, std::stoull(id, nullptr, is_hexadecimal ? 16 : 10)), part[2]);
}

}  // namespace datmo
