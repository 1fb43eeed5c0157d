// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/device/sick_telegram.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <limits>
#include <string_view>
#include <vector>

#include "datmo_fusion/common/angle.h"

namespace datmo {

namespace {

/// Scanners by the prefix of their names, with the range of their data sheets (m). Straight ahead
/// is 90 degrees in the frame of all of them, unlike LMS1000 and TiM2xx.
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
/// "LMS111": a name with one more digit belongs to another family.
constexpr std::size_t kModelCharacters = 6;

constexpr double kAngleUnit = 1e-4;  // deg

constexpr std::uint32_t kLongestScan = 1000000;  // us, until it is sent

/// Smaller values are codes for a missing range; among them, 0 means no echo.
constexpr std::uint32_t kFirstRange = 16;

/// Bytes of fields in CoLa B (Telegram listing 8014631, 4.3).
constexpr std::size_t kOne = 1;
constexpr std::size_t kTwo = 2;
constexpr std::size_t kFour = 4;

/// The values of one channel, and their meaning.
struct Channel {
  std::string_view content;
  float factor = 1.0F;
  float offset = 0.0F;
  double first_angle = 0.0;  ///< deg
  double spacing = 0.0;      ///< deg
  std::vector<std::uint32_t> values;
};

/// Reads a channel; `size`: bytes of a value in CoLa B.
Channel readChannel(ColaFields& fields, std::size_t size) {
  constexpr std::size_t kNameLength = 5;
  Channel channel;
  channel.content = fields.characters(kNameLength, "a channel's name");
  channel.factor = fields.real("its factor");
  channel.offset = fields.real("its offset");
  channel.first_angle = fields.signedNumber("its first angle") * kAngleUnit;
  channel.spacing = fields.number(kTwo, "its angle from beam to beam") * kAngleUnit;
  const std::uint32_t count = fields.number(kTwo, "its number of beams");
  if (channel.spacing <= 0.0 || channel.spacing * count > toDegrees(kTurn) + channel.spacing) {
    throw badAnswer(std::to_string(count) + " beams " + std::to_string(channel.spacing) +
                    " deg apart: expected at most a full turn");
  }
  fields.require(count, size, "a beam");
  channel.values.reserve(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    channel.values.push_back(fields.number(size, "a beam"));
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

/// Converts the ranges, and their geometry and timing.
void readDistances(const Channel& channel, double frequency, DeviceScan& scan) {
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

void readChannels(ColaFields& fields, std::size_t size, double frequency, DeviceScan& scan) {
  const std::uint32_t count = fields.number(kTwo, "the number of channels");
  for (std::uint32_t i = 0; i < count; ++i) {
    const Channel channel = readChannel(fields, size);
    if (channel.content == "DIST1") {
      readDistances(channel, frequency, scan);
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

/// Reads the fields up to the time of transmission.
void readStatus(ColaFields& fields, SickScan& scan) {
  fields.skip(kTwo, "its version");
  fields.skip(kTwo, "the device's number");
  fields.skip(kFour, "its serial number");
  fields.skip(kOne, "the first half of its state");
  scan.state = stateOf(fields.number(kOne, "its state"));
  fields.skip(kTwo, "the counter of telegrams");
  scan.counter = static_cast<std::uint16_t>(fields.number(kTwo, "the counter of scans"));
  scan.begun = fields.number(kFour, "the time of the scan");
  scan.sent = fields.number(kFour, "the time of its transmission");
  if (scan.sent - scan.begun > kLongestScan) {
    throw badAnswer("a scan that began at " + std::to_string(scan.begun) + " us and was sent at " +
                    std::to_string(scan.sent) + " us: expected at most a second between");
  }
}

/// Reads the fields up to the channels. Returns the frequency of the scans (Hz).
double takeFrequency(ColaFields& fields) {
  constexpr double kFrequencyUnit = 0.01;  // Hz
  for (const char* name : {"the inputs", "the inputs", "the outputs", "the outputs"}) {
    fields.skip(kOne, name);
  }
  fields.skip(kTwo, "the layer");
  const double frequency = fields.number(kFour, "the scans' frequency") * kFrequencyUnit;
  if (frequency <= 0.0) {
    throw badAnswer("a scan at a frequency of 0 Hz: expected more");
  }
  fields.skip(kFour, "the beams' frequency");
  const std::uint32_t encoders = fields.number(kTwo, "the number of encoders");
  for (std::uint32_t i = 0; i < encoders; ++i) {
    fields.skip(kFour, "an encoder's position");
    fields.skip(kTwo, "its speed");
  }
  return frequency;
}

}  // namespace

SickModel sickModel(const ColaTelegram& answer) {
  ColaFields fields(answer);
  const std::uint32_t length = fields.number(kTwo, "the length of the scanner's name");
  const std::string name(fields.characters(length, "the scanner's name"));
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

SickScan sickScan(const ColaTelegram& telegram, const SickModel& model) {
  ColaFields fields(telegram);
  SickScan scan;
  readStatus(fields, scan);
  const double frequency = takeFrequency(fields);
  readChannels(fields, kTwo, frequency, scan.scan);
  readChannels(fields, kOne, frequency, scan.scan);
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

bool isSickWarmingUp(const ColaTelegram& answer) {
  constexpr std::uint32_t kUndefined = 0;
  constexpr std::uint32_t kIdle = 3;
  constexpr std::uint32_t kMeasuring = 7;
  const auto state = ColaFields(answer).number(kTwo, "the scanner's state");
  // A scanner that was stopped must be started again, by a new connection.
  return state > kUndefined && state < kMeasuring && state != kIdle;
}

}  // namespace datmo
