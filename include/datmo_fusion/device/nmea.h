// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "datmo_fusion/device/device_data.h"

namespace datmo {

/// A sentence of NMEA 0183 (IEC 61162-1) with a valid checksum.
struct NmeaSentence {
  std::string type;                 ///< "GGA", without the talker
  std::vector<std::string> fields;  ///< after it; unknown ones are empty

  /// Returns a field; empty if there is none.
  std::string field(std::size_t index) const;

  /// Returns the number in a field; none if it is empty. Throws DeviceError (`bad_sentence`) unless
  /// it is finite.
  std::optional<double> number(std::size_t index) const;
};

/// Returns the checksum of the characters between $ and *.
std::uint8_t nmeaChecksum(std::string_view text);

/// Splits the bytes from a receiver into sentences.
class NmeaReader {
 public:
  void feed(std::string_view bytes) { waiting_ += bytes; }

  /// Returns the next complete sentence; none if it has not arrived yet. Bytes before its $ are
  /// skipped. Throws DeviceError (`bad_sentence`) for one whose checksum is missing or wrong, or
  /// that does not end.
  std::optional<NmeaSentence> next();

 private:
  std::string waiting_;
};

/// Returns the time since midnight (UTC), ms; none if the receiver does not know it. Throws
/// DeviceError (`bad_sentence`) for an invalid time.
std::optional<std::uint64_t> nmeaTime(std::string_view field);

/// Decodes GGA. `sigma`: m along each axis, of a position without corrections at an HDOP of 1.
/// Throws DeviceError (`bad_sentence`) for a position that is not on the earth.
SatelliteFix nmeaFix(const NmeaSentence& sentence, double sigma);

/// Decodes RMC or VTG; none if the receiver does not know its velocity. Throws DeviceError
/// (`bad_sentence`).
std::optional<GroundVelocity> nmeaVelocity(const NmeaSentence& sentence);

}  // namespace datmo
