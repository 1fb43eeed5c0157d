// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace datmo {

/// SCIP 2.0, the protocol of Hokuyo's scanners (Hokuyo Automatic, Communication protocol
/// specification for SCIP2.0 standard, UTM-30LX, 2008): lines of text, each answer ended by an
/// empty line.
struct ScipAnswer {
  std::string command;             ///< that it answers, as repeated by the device
  std::string status;              ///< two characters; "00": done
  std::vector<std::string> lines;  ///< with their checksums
};

/// Returns the last character of a line, which depends on the sum of all others.
char scipChecksum(std::string_view text);

/// Splits the bytes from the device into answers.
class ScipReader {
 public:
  void feed(std::string_view bytes) { waiting_ += bytes; }

  /// Returns the next complete answer; none if it has not arrived yet. Throws DeviceError
  /// (`bad_answer`) for one without a valid status, or that does not end.
  std::optional<ScipAnswer> next();

 private:
  std::string waiting_;
};

/// Properties that a scanner reports (PP).
struct ScipModel {
  std::string name;
  int min_range = 0;   ///< mm
  int max_range = 0;   ///< mm
  int turn_steps = 0;  ///< of a whole turn
  int first_step = 0;  ///< first one measured
  int last_step = 0;   ///< last one measured
  int front_step = 0;  ///< straight ahead
  double speed = 0.0;  ///< turns a minute

  std::size_t beams() const { return static_cast<std::size_t>(last_step - first_step + 1); }
  double beamSpacing() const;   ///< rad
  double firstBearing() const;  ///< rad, of the first beam; the x axis is straight ahead
  double scanTime() const { return kSecondsOfMinute / speed; }  ///< s, from a scan to the next
  double beamTime() const { return scanTime() / turn_steps; }   ///< s, from a beam to the next

  static constexpr double kSecondsOfMinute = 60.0;
};

/// Decodes an answer to PP. Throws DeviceError (`wrong_device`) if a value is missing, or
/// impossible for a scanner.
ScipModel scipModel(const ScipAnswer& answer);

/// Returns a request for all scans with all steps.
std::string scipScanRequest(const ScipModel& model);

struct ScipScan {
  std::uint32_t clock = 0;    ///< ms, of the device's clock, which has kScipClockBits
  std::vector<float> ranges;  ///< m; +inf: no return; NaN: no valid measurement
};

inline constexpr unsigned kScipClockBits = 24;

/// Decodes a scan. Throws DeviceError: `device_fault` for a status with which the device reports
/// that it cannot measure, `bad_answer` for a wrong checksum or number of beams.
ScipScan scipScan(const ScipAnswer& answer, const ScipModel& model);

}  // namespace datmo
