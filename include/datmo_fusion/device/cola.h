// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "datmo_fusion/device/device_data.h"

namespace datmo {

/// What a scanner is to speak, and how it is set.
inline constexpr const char* kColaDialect =
    "CoLa A; set it by SICK's SOPAS ET (network, Ethernet, CoLa dialect: ASCII)";

/// A telegram between the control characters that SICK's scanners put around it (CoLa A: SICK,
/// Telegram listing LMS1xx, LMS5xx, TiM5xx, TiM7xx, 8014631, 2020).
std::string colaTelegram(std::string_view text);

/// Cuts what comes from the device into telegrams.
class ColaReader {
 public:
  void feed(std::string_view bytes) { waiting_ += bytes; }

  /// The next whole telegram, without its control characters; none if it has not come. Throws
  /// DeviceError: `wrong_device` for the binary protocol (CoLa B), `bad_answer` for what does not
  /// end.
  std::optional<std::string> next();

 private:
  std::string waiting_;
};

/// The words of a telegram, from the front.
class ColaWords {
 public:
  explicit ColaWords(std::string_view telegram) : rest_(telegram) {}

  /// Throws DeviceError (`bad_answer`) if there is none. `name`: what it is, for the message.
  std::string_view text(const char* name);

  /// Hexadecimal, or decimal after a sign. Throws DeviceError (`bad_answer`) unless it is such a
  /// number of 32 bits.
  std::uint32_t number(const char* name);

  /// The same, of the two's complement: FFF92230 is -450000.
  std::int32_t signedNumber(const char* name);

  /// The bits of a float (IEEE 754): 3F800000 is 1.
  float real(const char* name);

  /// The next `count` characters after a space, which may be spaces, too. Throws DeviceError
  /// (`bad_answer`) if there are fewer.
  std::string_view characters(std::size_t count, const char* name);

 private:
  std::string_view rest_;
};

/// A scanner that this protocol has, and that has been looked up.
struct SickModel {
  std::string name;
  double max_range = 0.0;  ///< m
};

/// What the scanner says of itself (sRA DeviceIdent). Throws DeviceError (`wrong_device`) for one
/// whose ranges and bearings are not known here.
SickModel sickModel(std::string_view answer);

/// What a scanner says of its own state.
enum class SickState { kGood, kFault, kDirty };

struct SickScan {
  SickState state = SickState::kGood;
  std::uint16_t counter = 0;  ///< of all scans
  std::uint32_t begun = 0;    ///< us since it was switched on, when the scan began
  std::uint32_t sent = 0;     ///< the same, when it was sent
  DeviceScan scan;
};

/// A scan (sSN LMDscandata): the first echoes (DIST1), and their remission (RSSI1) where it is
/// there. No echo is +inf; the values that stand for errors, and what is nearer than them, are NaN.
/// Throws DeviceError (`bad_answer`) for one that is not whole, or has no such channel.
SickScan sickScan(std::string_view telegram, const SickModel& model);

}  // namespace datmo
