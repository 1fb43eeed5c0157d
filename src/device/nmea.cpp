// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/device/nmea.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/device/device_error.h"

namespace datmo {

namespace {

/// The standard's 82 characters, with a margin for receivers that exceed it.
constexpr std::size_t kLongestSentence = 256;

/// Standard deviations of differential corrections, RTK with and without whole cycles, relative to
/// that without corrections (Kaplan and Hegarty, Understanding GPS, 2006, 8.2).
constexpr double kDifferentialShare = 0.3;
constexpr double kFloatShare = 0.1;
constexpr double kFixedShare = 0.005;

/// Heights are less accurate by about this factor (ibid., 7.3).
constexpr double kVerticalShare = 1.5;

DeviceError badSentence(const std::string& what, const std::string& expected) {
  return {"bad_sentence", what + ": expected " + expected};
}

/// Decodes an angle: "4807.038" with two digits of degrees is 48 degrees and 7.038 minutes.
std::optional<double> angleOf(const NmeaSentence& sentence, std::size_t index, char negative) {
  constexpr double kDegree = 100.0;
  constexpr double kMinutes = 60.0;
  const std::optional<double> number = sentence.number(index);
  const std::string side = sentence.field(index + 1);
  if (!number || side.empty()) {
    return std::nullopt;
  }
  const double whole = std::floor(*number / kDegree);
  const double angle = whole + (*number - kDegree * whole) / kMinutes;
  return side[0] == negative ? -angle : angle;
}

/// Decodes the quality field of GGA.
SatelliteFix::Kind kindOf(const std::string& quality) {
  using Kind = SatelliteFix::Kind;
  if (quality == "1" || quality == "3" || quality == "8") {  // satellites, military, simulator
    return Kind::kSatellites;
  }
  if (quality == "2") {
    return Kind::kDifferential;
  }
  if (quality == "4" || quality == "5") {
    return Kind::kRealTimeKinematic;
  }
  return Kind::kNone;  // none, dead reckoning, manual
}

double shareOf(const std::string& quality) {
  return quality == "2"   ? kDifferentialShare
         : quality == "4" ? kFixedShare
         : quality == "5" ? kFloatShare
                          : 1.0;
}

}  // namespace

std::string NmeaSentence::field(std::size_t index) const {
  return index < fields.size() ? fields[index] : "";
}

std::optional<double> NmeaSentence::number(std::size_t index) const {
  const std::string text = field(index);
  if (text.empty()) {
    return std::nullopt;
  }
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (end != text.c_str() + text.size() || !std::isfinite(value)) {
    throw badSentence(shownBytes(text) + " in " + type, "a number");
  }
  return value;
}

std::uint8_t nmeaChecksum(std::string_view text) {
  unsigned sum = 0;
  for (const char c : text) {
    sum ^= static_cast<unsigned char>(c);
  }
  return static_cast<std::uint8_t>(sum);
}

std::optional<NmeaSentence> NmeaReader::next() {
  constexpr std::size_t kTalker = 2;
  constexpr std::size_t kChecksum = 3;  // * and two digits
  std::size_t end = waiting_.find('\n');
  std::string line;
  while (end != std::string::npos && line.empty()) {
    const std::size_t start = waiting_.rfind('$', end);
    line = start == std::string::npos ? "" : waiting_.substr(start + 1, end - start - 1);
    waiting_.erase(0, end + 1);
    end = waiting_.find('\n');
  }
  if (line.empty()) {
    if (waiting_.size() > kLongestSentence) {
      const std::string shown = shownBytes(waiting_);
      waiting_.erase(0, kLongestSentence);
      throw badSentence(shown + " and so on", "sentences of NMEA 0183; is the baud rate right?");
    }
    return std::nullopt;
  }
  const std::size_t star = line.find('*');
  char checksum[kChecksum];
  std::snprintf(checksum, sizeof checksum, "%02X", nmeaChecksum(line.substr(0, star)));
  std::string digits = star == std::string::npos ? "" : line.substr(star + 1, 2);
  // Some receivers write the digits in lower case.
  std::transform(digits.begin(), digits.end(), digits.begin(),
                 [](unsigned char digit) { return static_cast<char>(std::toupper(digit)); });
  if (digits != checksum) {
    throw badSentence(shownBytes(line), "one with the checksum " + std::string(checksum));
  }
  NmeaSentence sentence;
  const std::string text = line.substr(0, star) + ",";
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t to = text.find(',', from);
    sentence.fields.push_back(text.substr(from, to - from));
    from = to + 1;
  }
  const std::string address = sentence.fields.front();
  sentence.type = address.size() > kTalker ? address.substr(kTalker) : address;
  sentence.fields.erase(sentence.fields.begin());
  return sentence;
}

std::optional<std::uint64_t> nmeaTime(std::string_view field) {
  constexpr double kMillisecondsOfSecond = 1e3;
  constexpr int kOfMinute = 60;
  constexpr std::size_t kDigits = 6;
  if (field.empty()) {
    return std::nullopt;
  }
  int hours = 0;
  int minutes = 0;
  double seconds = 0.0;
  const std::string text(field);
  const int read = std::sscanf(text.c_str(), "%2d%2d%lf", &hours, &minutes, &seconds);
  if (field.size() < kDigits || read != 3 || hours < 0 || hours > 23 || minutes < 0 ||
      minutes >= kOfMinute || !(seconds >= 0.0 && seconds <= kOfMinute)) {
    throw badSentence(shownBytes(field), "a time, hhmmss.ss");
  }
  return static_cast<std::uint64_t>(
      std::llround((kOfMinute * (kOfMinute * hours + minutes) + seconds) * kMillisecondsOfSecond));
}

SatelliteFix nmeaFix(const NmeaSentence& sentence, double sigma) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  constexpr double kQuarter = 90.0;        // deg
  constexpr double kMaxSatellites = 99.0;  // two digits
  const std::string quality = sentence.field(5);
  SatelliteFix fix;
  fix.kind = kindOf(quality);
  fix.latitude = angleOf(sentence, 1, 'S').value_or(kNaN);
  fix.longitude = angleOf(sentence, 3, 'W').value_or(kNaN);
  fix.satellites =
      static_cast<int>(std::clamp(sentence.number(6).value_or(0.0), 0.0, kMaxSatellites));
  // Height above sea level, and of sea level above the ellipsoid: both are required.
  fix.altitude = sentence.number(8).value_or(kNaN) + sentence.number(10).value_or(kNaN);
  const bool is_there =
      std::abs(fix.latitude) <= kQuarter && std::abs(fix.longitude) <= 2.0 * kQuarter;
  if (fix.kind != SatelliteFix::Kind::kNone && !is_there) {
    throw badSentence(
        "a position at latitude " + sentence.field(1) + ", longitude " + sentence.field(3),
        "one on the earth");
  }
  const double hdop = sentence.number(7).value_or(1.0);
  const double dilution = hdop > 0.0 ? hdop : 1.0;  // 0 or missing: unknown
  fix.sigma = sigma * shareOf(quality) * dilution;
  fix.vertical_sigma = kVerticalShare * fix.sigma;
  return fix;
}

std::optional<GroundVelocity> nmeaVelocity(const NmeaSentence& sentence) {
  constexpr double kKnot = 1852.0 / 3600.0;  // m/s
  const bool is_rmc = sentence.type == "RMC";
  // Newer receivers end both with a mode: N marks invalid data.
  const bool is_valid = sentence.field(is_rmc ? 11 : 8) != "N";
  if (!is_valid || (is_rmc && sentence.field(1) != "A")) {
    return std::nullopt;
  }
  const std::optional<double> knots = sentence.number(is_rmc ? 6 : 4);
  if (!knots) {
    return std::nullopt;
  }
  if (*knots < 0.0) {
    throw badSentence("a speed of " + std::to_string(*knots) + " knots", "0 or more");
  }
  // At rest it is missing.
  const double course = sentence.number(is_rmc ? 7 : 0).value_or(0.0);
  return GroundVelocity{*knots * kKnot, degrees(course)};
}

}  // namespace datmo
