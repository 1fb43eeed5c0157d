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
/// specification for SCIP2.0 standard, UTM-30LX, 2008): lines of text, each answer closed by an
/// empty one.
struct ScipAnswer {
  std::string command;             ///< that it answers, as the device repeats it
  std::string status;              ///< two characters; "00": done
  std::vector<std::string> lines;  ///< with their checksums
};

/// The last character of a line: of the sum of all others.
char scipChecksum(std::string_view text);

/// Cuts what comes from the device into answers.
class ScipReader {
 public:
  void feed(std::string_view bytes) { waiting_ += bytes; }

  /// The next whole answer; none if it has not come. Throws DeviceError (`bad_answer`) for one
  /// without a valid status, or that does not end.
  std::optional<ScipAnswer> next();

 private:
  std::string waiting_;
};

/// What a scanner says of itself (PP).
struct ScipModel {
  std::string name;
  int min_range = 0;   ///< mm
  int max_range = 0;   ///< mm
  int turn_steps = 0;  ///< of a whole turn
  int first_step = 0;  ///< that it measures
  int last_step = 0;   ///< the same
  int front_step = 0;  ///< straight ahead
  double speed = 0.0;  ///< turns a minute

  std::size_t beams() const { return static_cast<std::size_t>(last_step - first_step + 1); }
  double beamSpacing() const;   ///< rad
  double firstBearing() const;  ///< rad, of the first beam; the x axis is straight ahead
  double scanTime() const { return kSecondsOfMinute / speed; }  ///< s, from a scan to the next
  double beamTime() const { return scanTime() / turn_steps; }   ///< s, from a beam to the next

  static constexpr double kSecondsOfMinute = 60.0;
};

/// Throws DeviceError (`wrong_device`) if the answer lacks a value, or has one that no scanner has.
ScipModel scipModel(const ScipAnswer& answer);

/// Asks for all scans of all steps.
std::string scipScanRequest(const ScipModel& model);

struct ScipScan {
  std::uint32_t clock = 0;    ///< ms, of the device's clock, which has kScipClockBits
  std::vector<float> ranges;  ///< m; +inf: no return; NaN: no valid measurement
};

inline constexpr unsigned kScipClockBits = 24;

/// The answer that a scan is. Throws DeviceError: `device_fault` for a status that says that the
/// device cannot measure, `bad_answer` for a wrong checksum or number of beams.
ScipScan scipScan(const ScipAnswer& answer, const ScipModel& model);

}  // namespace datmo
