// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/device/cola.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/device/device_error.h"

namespace datmo {

namespace {

constexpr char kStart = '\x02';
constexpr char kEnd = '\x03';

/// No telegram is longer: five echoes and their remission in 1,141 beams, six characters each.
constexpr std::size_t kLongestTelegram = 131072;

/// Scanners by the beginning of their names, with the range of their data sheets (m). All look
/// straight ahead at 90 degrees of their own, unlike LMS1000 and TiM2xx.
struct Family {
  std::string_view prefix;
  double max_range;
};
constexpr std::array<Family, 11> kFamilies = {{{"LMS10", 20.0},
                                               {"LMS11", 20.0},
                                               {"LMS12", 20.0},
                                               {"LMS13", 20.0},
                                               {"LMS14", 50.0},
                                               {"LMS15", 50.0},
                                               {"LMS5", 80.0},
                                               {"TiM55", 10.0},
                                               {"TiM56", 10.0},
                                               {"TiM57", 25.0},
                                               {"TiM7", 25.0}}};
constexpr double kAhead = 90.0;  // deg
/// "LMS111": what has a digit more is of another family.
constexpr std::size_t kModelCharacters = 6;

constexpr double kAngleUnit = 1e-4;  // deg

constexpr std::uint32_t kLongestScan = 1000000;  // us, until it is sent

/// Values below stand for why there is no range; 0 of them for an echo that did not come.
constexpr std::uint32_t kFirstRange = 16;

DeviceError badAnswer(const std::string& text) { return {"bad_answer", text}; }

/// The values of one channel, and what they mean.
struct Channel {
  std::string_view content;
  float factor = 1.0F;
  float offset = 0.0F;
  double first_angle = 0.0;  ///< deg
  double spacing = 0.0;      ///< deg
  std::vector<std::uint32_t> values;
};

Channel readChannel(ColaWords& words) {
  Channel channel;
  channel.content = words.text("a channel's name");
  channel.factor = words.real("its factor");
  channel.offset = words.real("its offset");
  channel.first_angle = words.signedNumber("its first angle") * kAngleUnit;
  channel.spacing = words.number("its angle from beam to beam") * kAngleUnit;
  const std::uint32_t count = words.number("its number of beams");
  if (channel.spacing <= 0.0 || channel.spacing * count > toDegrees(kTurn) + channel.spacing) {
    throw badAnswer(std::to_string(count) + " beams " + std::to_string(channel.spacing) +
                    " deg apart: expected a turn at most");
  }
  channel.values.reserve(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    channel.values.push_back(words.number("a beam"));
  }
  return channel;
}

float rangeOf(std::uint32_t value, const Channel& channel) {
  constexpr float kMeter = 1000.0F;  // mm
  if (value == 0) {
    return std::numeric_limits<float>::infinity();
  }
  if (value < kFirstRange) {
    return std::numeric_limits<float>::quiet_NaN();
  }
  return (static_cast<float>(value) * channel.factor + channel.offset) / kMeter;
}

/// The ranges and all that is said of them.
void takeDistances(const Channel& channel, double frequency, DeviceScan& scan) {
  constexpr double kMillimeter = 1e-3;  // m
  scan.first_bearing = degrees(channel.first_angle - kAhead);
  scan.beam_spacing = degrees(channel.spacing);
  scan.scan_time = 1.0 / frequency;
  scan.beam_time = scan.scan_time * scan.beam_spacing / kTurn;
  scan.min_range = kFirstRange * static_cast<double>(channel.factor) * kMillimeter;
  for (const std::uint32_t value : channel.values) {
    scan.ranges.push_back(rangeOf(value, channel));
  }
}

void takeChannels(ColaWords& words, double frequency, DeviceScan& scan) {
  const std::uint32_t count = words.number("the number of channels");
  for (std::uint32_t i = 0; i < count; ++i) {
    const Channel channel = readChannel(words);
    if (channel.content == "DIST1") {
      takeDistances(channel, frequency, scan);
    } else if (channel.content == "RSSI1") {
      for (const std::uint32_t value : channel.values) {
        scan.intensities.push_back(static_cast<float>(value) * channel.factor + channel.offset);
      }
    }
  }
}

SickState stateOf(std::uint32_t status) {
  constexpr std::uint32_t kErrorBit = 1;
  return status == 0                 ? SickState::kGood
         : (status & kErrorBit) != 0 ? SickState::kFault
                                     : SickState::kDirty;
}

}  // namespace

std::string colaTelegram(std::string_view text) { return kStart + std::string(text) + kEnd; }

std::optional<std::string> ColaReader::next() {
  if (waiting_.rfind(std::string(4, kStart), 0) == 0) {
    throw DeviceError("wrong_device",
                      std::string("the scanner speaks CoLa B: expected ") + kColaDialect);
  }
  const std::size_t end = waiting_.find(kEnd);
  if (end == std::string::npos) {
    if (waiting_.size() > kLongestTelegram) {
      throw badAnswer(shownBytes(waiting_) + " and so on: expected a telegram's end within " +
                      std::to_string(kLongestTelegram) + " bytes");
    }
    return std::nullopt;
  }
  // The last beginning: what was before it was cut off.
  const std::size_t start = waiting_.rfind(kStart, end);
  if (start == std::string::npos) {
    throw badAnswer(shownBytes(waiting_) + ": expected a telegram of CoLa A, which begins by STX");
  }
  std::string telegram = waiting_.substr(start + 1, end - start - 1);
  waiting_.erase(0, end + 1);
  return telegram;
}

std::string_view ColaWords::text(const char* name) {
  rest_.remove_prefix(std::min(rest_.find_first_not_of(' '), rest_.size()));
  const std::string_view word = rest_.substr(0, rest_.find(' '));
  if (word.empty()) {
    throw badAnswer(std::string("a telegram that ends before ") + name + ": expected a whole one");
  }
  rest_.remove_prefix(word.size());
  return word;
}

std::uint32_t ColaWords::number(const char* name) {
  constexpr int kHexadecimal = 16;
  constexpr int kDecimal = 10;
  const std::string_view word = text(name);
  const bool has_sign = word[0] == '+' || word[0] == '-';
  const char* const first = word.data() + (word[0] == '+' ? 1 : 0);
  const char* const last = word.data() + word.size();
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(first, last, value, has_sign ? kDecimal : kHexadecimal);
  if (error != std::errc() || end != last || value < std::numeric_limits<std::int32_t>::min() ||
      value > std::numeric_limits<std::uint32_t>::max()) {
    throw badAnswer(shownBytes(word) + " as " + name + ": expected a number of 32 bits");
  }
  return static_cast<std::uint32_t>(value);
}

std::int32_t ColaWords::signedNumber(const char* name) {
  return static_cast<std::int32_t>(number(name));
}

float ColaWords::real(const char* name) {
  const std::uint32_t bits = number(name);
  float value = 0.0F;
  static_assert(sizeof value == sizeof bits);
  std::memcpy(&value, &bits, sizeof value);
  if (!std::isfinite(value)) {
    throw badAnswer(std::string(name) + " is not finite: expected a number");
  }
  return value;
}

std::string_view ColaWords::characters(std::size_t count, const char* name) {
  if (rest_.size() < count + 1) {
    throw badAnswer(std::string("a telegram that ends within ") + name + ": expected a whole one");
  }
  const std::string_view found = rest_.substr(1, count);
  rest_.remove_prefix(count + 1);
  return found;
}

SickModel sickModel(std::string_view answer) {
  ColaWords words(answer);
  words.text("the kind of answer");
  words.text("the name of what was asked for");
  const std::uint32_t length = words.number("the length of the scanner's name");
  const std::string name(words.characters(length, "the scanner's name"));
  const bool is_longer = name.size() > kModelCharacters &&
                         std::isdigit(static_cast<unsigned char>(name[kModelCharacters])) != 0;
  const auto* const family = std::find_if(
      kFamilies.begin(), kFamilies.end(),
      [&name](const Family& one) { return name.compare(0, one.prefix.size(), one.prefix) == 0; });
  if (is_longer || family == kFamilies.end()) {
    throw DeviceError("wrong_device", "the device is a " + shownBytes(name) +
                                          ": expected an LMS1xx, LMS5xx, TiM5xx or TiM7xx");
  }
  return {name, family->max_range};
}

SickScan sickScan(std::string_view telegram, const SickModel& model) {
  constexpr double kFrequencyUnit = 0.01;  // Hz
  ColaWords words(telegram);
  SickScan scan;
  for (const char* name : {"the kind of telegram", "its name", "its version", "the device's number",
                           "its serial number", "the first half of its state"}) {
    words.text(name);
  }
  scan.state = stateOf(words.number("its state"));
  words.number("the counter of telegrams");
  scan.counter = static_cast<std::uint16_t>(words.number("the counter of scans"));
  scan.begun = words.number("the time of the scan");
  scan.sent = words.number("the time of its transmission");
  if (scan.sent - scan.begun > kLongestScan) {
    throw badAnswer("a scan that began at " + std::to_string(scan.begun) + " us and was sent at " +
                    std::to_string(scan.sent) + " us: expected a second between at most");
  }
  for (const char* name : {"the inputs", "the inputs", "the outputs", "the outputs", "the layer"}) {
    words.text(name);
  }
  const double frequency = words.number("the scans' frequency") * kFrequencyUnit;
  if (frequency <= 0.0) {
    throw badAnswer("a scan at a frequency of 0 Hz: expected more");
  }
  words.number("the beams' frequency");
  const std::uint32_t encoders = words.number("the number of encoders");
  for (std::uint32_t i = 0; i < encoders; ++i) {
    words.text("an encoder's position");
    words.text("its speed");
  }
  takeChannels(words, frequency, scan.scan);  // of 16 bits
  takeChannels(words, frequency, scan.scan);  // of 8 bits
  scan.scan.max_range = model.max_range;
  if (scan.scan.ranges.size() < 2) {
    throw badAnswer("a scan of " + std::to_string(scan.scan.ranges.size()) +
                    " distances (DIST1): expected two or more");
  }
  if (scan.scan.intensities.size() != scan.scan.ranges.size()) {
    scan.scan.intensities.clear();
  }
  return scan;
}

}  // namespace datmo
