// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/device/can_log.h"

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "can_number.h"

namespace datmo {

namespace {

/// s, the largest ROS time.
constexpr double kMaxTime = 4294967295.0;

/// Removes the next word from the front and returns it; empty if there is none.
std::string_view nextWord(std::string_view& rest) {
  constexpr std::string_view kSpace = " \t\r";
  rest.remove_prefix(std::min(rest.find_first_not_of(kSpace), rest.size()));
  const std::string_view found = rest.substr(0, rest.find_first_of(kSpace));
  rest.remove_prefix(found.size());
  return found;
}

[[noreturn]] void refuseLine(std::string_view line) {
  throw CanFrameError("a line " + shownBytes(line) +
                      ": expected one of candump -L, '(1436509052.249713) can0 1A0#2A366C2B'");
}

/// Parses hexadecimal digits only.
std::uint32_t hexadecimal(std::string_view digits, std::string_view line) {
  constexpr std::size_t kLongest = 8;
  constexpr int kBase = 16;
  if (digits.empty() || digits.size() > kLongest ||
      digits.find_first_not_of("0123456789abcdefABCDEF") != std::string_view::npos) {
    refuseLine(line);
  }
  return static_cast<std::uint32_t>(std::stoul(std::string(digits), nullptr, kBase));
}

double timeOfLine(std::string_view field, std::string_view line) {
  if (field.size() < 3 || field.front() != '(' || field.back() != ')' ||
      field.find_first_not_of("0123456789.", 1) != field.size() - 1) {
    refuseLine(line);
  }
  const std::string number(field.substr(1, field.size() - 2));
  std::size_t read = 0;
  double time = 0.0;
  try {
    time = std::stod(number, &read);
  } catch (const std::exception&) {
    refuseLine(line);
  }
  if (read != number.size() || time > kMaxTime) {
    refuseLine(line);
  }
  return time;
}

void readData(std::string_view digits, std::size_t longest, std::string_view line,
              CanFrame& frame) {
  if (digits.size() % 2 != 0 || digits.size() / 2 > longest) {
    refuseLine(line);
  }
  frame.size = static_cast<std::uint8_t>(digits.size() / 2);
  for (std::size_t i = 0; i < frame.size; ++i) {
    frame.data[i] = static_cast<std::uint8_t>(hexadecimal(digits.substr(2 * i, 2), line));
  }
}

}  // namespace

std::optional<LoggedCanFrame> canLogLine(std::string_view line) {
  constexpr std::size_t kStandardDigits = 3;
  constexpr std::size_t kExtendedDigits = 8;
  constexpr std::size_t kClassic = 8;  // bytes
  std::string_view rest = line;
  const std::string_view time = nextWord(rest);
  if (time.empty()) {
    return std::nullopt;
  }
  LoggedCanFrame logged;
  logged.time = timeOfLine(time, line);
  logged.interface = nextWord(rest);
  const std::string_view text = nextWord(rest);
  const std::size_t mark = text.find('#');
  if (mark != kStandardDigits && mark != kExtendedDigits) {
    refuseLine(line);
  }
  setNumber(hexadecimal(text.substr(0, mark), line), mark == kExtendedDigits, logged.frame);
  std::string_view data = text.substr(mark + 1);
  if (!data.empty() && data.front() == 'R') {
    return std::nullopt;
  }
  if (!data.empty() && data.front() == '#') {
    hexadecimal(data.substr(1, 1), line);  // flags, which are irrelevant here
    readData(data.substr(2), CanFrame::kLongest, line, logged.frame);
  } else {
    data = data.substr(0, data.find('_'));  // after it: a length code of more than 8
    readData(data, kClassic, line, logged.frame);
  }
  return logged;
}

CanLog::CanLog(std::string file, std::string interface, const std::atomic<bool>& stop)
    : file_(std::move(file)), interface_(std::move(interface)), stream_(file_), pace_(stop) {
  if (!stream_) {
    throw DeviceError("bad_recording", file_ + " cannot be read (" + std::strerror(errno) +
                                           "): expected a log of candump -L");
  }
}

CanFrame CanLog::next() {
  for (std::string line; std::getline(stream_, line);) {
    ++lines_;
    std::optional<LoggedCanFrame> logged;
    try {
      logged = canLogLine(line);
    } catch (const CanFrameError& error) {
      throw CanFrameError(file_ + ", line " + std::to_string(lines_) + ": " + error.what());
    }
    if (!logged) {
      continue;
    }
    if (!interface_.empty() && logged->interface != interface_) {
      other_interface_ = logged->interface;
      continue;
    }
    if (logged->time < last_) {
      pace_.restart();
    }
    last_ = logged->time;
    pace_.waitUntil(logged->time);
    return logged->frame;
  }
  throw RecordingEnd(file_ + " was played to its end" +
                     (other_interface_.empty()
                          ? ""
                          : " (frames of " + other_interface_ + " are not of " + interface_ +
                                ", and were ignored)"));
}

}  // namespace datmo
