// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "datmo_fusion/device/device_data.h"

namespace datmo {

/// A sentence of NMEA 0183 (IEC 61162-1), whose checksum fits.
struct NmeaSentence {
  std::string type;                 ///< "GGA", whoever the talker is
  std::vector<std::string> fields;  ///< after it; those that are not known are empty

  /// Empty where there is none.
  std::string field(std::size_t index) const;

  /// Throws DeviceError (`bad_sentence`) for what is neither empty nor a finite number.
  std::optional<double> number(std::size_t index) const;
};

/// Of the characters between $ and *.
std::uint8_t nmeaChecksum(std::string_view text);

/// Cuts what comes from a receiver into sentences.
class NmeaReader {
 public:
  void feed(std::string_view bytes) { waiting_ += bytes; }

  /// The next whole sentence; none if it has not come. What is before its $ is passed over. Throws
  /// DeviceError (`bad_sentence`) for one whose checksum is missing or does not fit, or that does
  /// not end.
  std::optional<NmeaSentence> next();

 private:
  std::string waiting_;
};

/// ms since midnight (UTC); none where the receiver does not know it. Throws DeviceError
/// (`bad_sentence`) for a time that is none.
std::optional<std::uint64_t> nmeaTime(std::string_view field);

/// GGA. `sigma`: m along each axis, of a position without corrections where HDOP is 1. Throws
/// DeviceError (`bad_sentence`) for one that is not on the earth.
SatelliteFix nmeaFix(const NmeaSentence& sentence, double sigma);

/// RMC or VTG; none where the receiver does not know it. Throws DeviceError (`bad_sentence`).
std::optional<GroundVelocity> nmeaVelocity(const NmeaSentence& sentence);

}  // namespace datmo
