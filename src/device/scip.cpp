// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/device/scip.h"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <limits>
#include <map>

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/device/device_error.h"

namespace datmo {

namespace {

/// Characters of the protocol carry six bits each, from '0' on.
constexpr unsigned kBits = 6;
constexpr unsigned kMask = (1U << kBits) - 1U;
constexpr char kZero = '0';

constexpr std::size_t kRangeCharacters = 3;
constexpr std::size_t kClockCharacters = 4;

/// The longest answer: the most steps that a request can specify, three characters each, with a
/// margin.
constexpr std::size_t kLongestAnswer = 65536;

std::uint32_t decoded(std::string_view characters) {
  std::uint32_t value = 0;
  for (const char c : characters) {
    value = (value << kBits) | (static_cast<unsigned>(c - kZero) & kMask);
  }
  return value;
}

bool isChecked(std::string_view line) {
  return line.size() >= 2 && scipChecksum(line.substr(0, line.size() - 1)) == line.back();
}

std::string_view withoutChecksum(std::string_view line) {
  if (!isChecked(line)) {
    throw DeviceError("bad_answer", "line " + shownBytes(line) +
                                        " of a scan: expected one that matches its checksum");
  }
  return line.substr(0, line.size() - 1);
}

/// Returns the fields `NAME:value;` of an answer.
std::map<std::string, std::string> fieldsOf(const ScipAnswer& answer) {
  std::map<std::string, std::string> fields;
  for (const std::string& line : answer.lines) {
    const std::size_t colon = line.find(':');
    // The last character is the checksum, which may also be a semicolon.
    const std::size_t end = line.size() - std::min<std::size_t>(line.size(), 2);
    if (colon < end && line[end] == ';') {
      fields[line.substr(0, colon)] = line.substr(colon + 1, end - colon - 1);
    }
  }
  return fields;
}

int numberOf(const std::map<std::string, std::string>& fields, const std::string& name) {
  const auto field = fields.find(name);
  int value = 0;
  if (field != fields.end()) {
    const std::string& text = field->second;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc() && end == text.data() + text.size()) {
      return value;
    }
  }
  throw DeviceError("wrong_device",
                    "the device reports " + name + " = " +
                        (field == fields.end() ? "nothing" : shownBytes(field->second)) +
                        ": expected a number, as from a scanner with SCIP 2.0");
}

void check(const ScipModel& model) {
  constexpr int kMaxSteps = 9999;  // a request has four digits for each
  const bool is_scanner = model.turn_steps > 0 && model.speed > 0.0 && model.first_step >= 0 &&
                          model.last_step > model.first_step && model.last_step <= kMaxSteps &&
                          model.min_range >= 0 && model.max_range > model.min_range;
  if (!is_scanner) {
    throw DeviceError(
        "wrong_device",
        "'" + model.name + "' measures steps " + std::to_string(model.first_step) + " to " +
            std::to_string(model.last_step) + " of " + std::to_string(model.turn_steps) + " from " +
            std::to_string(model.min_range) + " to " + std::to_string(model.max_range) + " mm at " +
            std::to_string(model.speed) + " turns a minute: expected those of a scanner");
  }
}

float rangeOf(std::uint32_t millimeters, const ScipModel& model) {
  constexpr float kMeter = 1000.0F;  // mm
  if (millimeters < static_cast<std::uint32_t>(model.min_range)) {
    return std::numeric_limits<float>::quiet_NaN();  // an error code instead of a range
  }
  if (millimeters > static_cast<std::uint32_t>(model.max_range)) {
    return std::numeric_limits<float>::infinity();
  }
  return static_cast<float>(millimeters) / kMeter;
}

}  // namespace

char scipChecksum(std::string_view text) {
  unsigned sum = 0;
  for (const char c : text) {
    sum += static_cast<unsigned char>(c);
  }
  return static_cast<char>((sum & kMask) + kZero);
}

std::optional<ScipAnswer> ScipReader::next() {
  const std::size_t end = waiting_.find("\n\n");
  if (end == std::string::npos) {
    if (waiting_.size() > kLongestAnswer) {
      throw DeviceError("bad_answer", shownBytes(waiting_) +
                                          " and so on: expected an answer's end " + "within " +
                                          std::to_string(kLongestAnswer) + " bytes");
    }
    return std::nullopt;
  }
  ScipAnswer answer;
  std::vector<std::string> lines;
  for (std::size_t from = 0; from <= end;) {
    const std::size_t to = waiting_.find('\n', from);
    lines.push_back(waiting_.substr(from, to - from));
    from = to + 1;
  }
  waiting_.erase(0, end + 2);
  constexpr std::size_t kStatusCharacters = 3;
  if (lines.size() < 2 || lines[1].size() != kStatusCharacters || !isChecked(lines[1])) {
    throw DeviceError("bad_answer",
                      shownBytes(lines[0]) + ", " + shownBytes(lines.size() < 2 ? "" : lines[1]) +
                          ": expected an answer with a status; is it a scanner with SCIP 2.0?");
  }
  answer.command = lines[0];
  answer.status = lines[1].substr(0, 2);
  answer.lines.assign(lines.begin() + 2, lines.end());
  return answer;
}

double ScipModel::beamSpacing() const { return kTurn / turn_steps; }

double ScipModel::firstBearing() const { return (first_step - front_step) * beamSpacing(); }

ScipModel scipModel(const ScipAnswer& answer) {
  const auto fields = fieldsOf(answer);
  const auto name = fields.find("MODL");
  ScipModel model;
  model.name = name == fields.end() ? "" : name->second;
  model.min_range = numberOf(fields, "DMIN");
  model.max_range = numberOf(fields, "DMAX");
  model.turn_steps = numberOf(fields, "ARES");
  model.first_step = numberOf(fields, "AMIN");
  model.last_step = numberOf(fields, "AMAX");
  model.front_step = numberOf(fields, "AFRT");
  model.speed = numberOf(fields, "SCAN");
  check(model);
  return model;
}

std::string scipScanRequest(const ScipModel& model) {
  // Each step separately (01), no scan skipped (0), endless (00).
  char request[32];
  std::snprintf(request, sizeof request, "MD%04d%04d01000", model.first_step, model.last_step);
  return request;
}

ScipScan scipScan(const ScipAnswer& answer, const ScipModel& model) {
  if (answer.status != "99") {
    throw DeviceError("device_fault", "the scanner answers with status " +
                                          shownBytes(answer.status) +
                                          ": expected 99, a scan; see its manual for the cause");
  }
  if (answer.lines.empty()) {
    throw DeviceError("bad_answer", "a scan without a time: expected one");
  }
  const std::string_view clock = withoutChecksum(answer.lines.front());
  std::string data;
  for (std::size_t i = 1; i < answer.lines.size(); ++i) {
    data += withoutChecksum(answer.lines[i]);
  }
  if (clock.size() != kClockCharacters || data.size() != kRangeCharacters * model.beams()) {
    throw DeviceError("bad_answer", "a scan of " + std::to_string(data.size()) +
                                        " characters: expected " +
                                        std::to_string(kRangeCharacters * model.beams()));
  }
  ScipScan scan;
  scan.clock = decoded(clock);
  scan.ranges.reserve(model.beams());
  for (std::size_t i = 0; i < data.size(); i += kRangeCharacters) {
    scan.ranges.push_back(
        rangeOf(decoded(std::string_view(data).substr(i, kRangeCharacters)), model));
  }
  return scan;
}

}  // namespace datmo
