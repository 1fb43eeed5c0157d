// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/repeat_filter.h"

#include <cctype>

namespace datmo {

namespace {

/// s without an error after which its return is reported again: an operator has looked away by
/// then.
constexpr double kLongQuiet = 60.0;

/// Maximum number of reported causes per reason: ever-changing names must not fill the console.
constexpr std::size_t kMaxCauses = 20;

bool isDigit(char character) { return std::isdigit(static_cast<unsigned char>(character)) != 0; }

/// Whether a digit after `before` belongs to a name: laser_1, imu2, /robot/3.
bool isPartOfName(char before) {
  return std::isalnum(static_cast<unsigned char>(before)) != 0 || before == '_' || before == '/';
}

std::size_t endOfNumber(const std::string& text, std::size_t begin) {
  std::size_t end = begin;
  while (end < text.size() && (isDigit(text[end]) || (text[end] == '.' && end + 1 < text.size() &&
                                                      isDigit(text[end + 1])))) {
    ++end;
  }
  return end;
}

/// The message without its numbers, except those in names.
std::string causeIn(const std::string& message) {
  std::string cause;
  for (std::size_t i = 0; i < message.size();) {
    const bool in_name = i > 0 && isPartOfName(message[i - 1]);
    const std::size_t digits = message[i] == '-' ? i + 1 : i;
    if (!in_name && digits < message.size() && isDigit(message[digits])) {
      i = endOfNumber(message, digits);
      cause += '#';
    } else {
      cause += message[i++];
    }
  }
  return cause;
}

}  // namespace

std::optional<std::string> RepeatFilter::lineOf(const InputError& error, double now,
                                                std::uint64_t count) {
  Reason& reason = reasons_[error.reason()];
  reason.count += count;
  if (!isNews(reason, causeIn(error.what()), now)) {
    return std::nullopt;
  }
  const std::string line = error.what();
  if (reason.count == count) {
    return line;
  }
  return line + " (" + error.reason() + ": " + std::to_string(reason.count) + " so far)";
}

bool RepeatFilter::isNews(Reason& reason, const std::string& cause, double now) {
  const auto found = reason.last_seen.find(cause);
  if (found != reason.last_seen.end()) {
    const double quiet = now - found->second;
    found->second = now;
    return quiet > kLongQuiet;
  }
  if (reason.last_seen.size() >= kMaxCauses) {
    return false;
  }
  reason.last_seen.emplace(cause, now);
  return true;
}

}  // namespace datmo
